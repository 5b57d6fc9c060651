// armsreach sources: what can be opened here, and for what cannot: why, and what mends it.
#include <cstdio>

#include "app/cli/commands.hpp"
#include "app/cli/source_kinds.hpp"
#include "devices/serial_ports.hpp"

namespace armsreach::app {
namespace {

void print(const Availability& one) {
  std::printf("%-3s  %-28s  %s\n", one.usable ? "yes" : "no", one.spec.c_str(), one.detail.c_str());
  if (!one.usable) std::printf("     %-28s  -> %s\n", "", one.remedy.c_str());
}

Status list_sources() {
  for (const SourceKind& kind : all_source_kinds())
    for (const Availability& source : kind.probe()) print(source);
  for (const Availability& port : probe_serial_ports()) print(port);
  std::printf("\nHow to write them, for --source:\n");
  for (const SourceKind& kind : all_source_kinds()) std::printf("  %s\n", kind.usage.c_str());
  return ok();
}

}  // namespace

void add_sources_command(CLI::App& app, Task* task) {
  CLI::App* command = app.add_subcommand("sources", "what can be opened on this machine");
  command->callback([task] { *task = list_sources; });
}

}  // namespace armsreach::app

// armsreach sources: what can be opened here, and for what cannot: why, and what mends it.
#include <cstdio>

#include "app/cli/commands.hpp"
#include "app/cli/source_kinds.hpp"

namespace armsreach::app {
namespace {

Status list_sources() {
  for (const SourceKind& kind : all_source_kinds()) {
    for (const Availability& source : kind.probe()) {
      std::printf("%-3s  %-28s  %s\n", source.usable ? "yes" : "no", source.spec.c_str(),
                  source.detail.c_str());
      if (!source.usable) std::printf("     %-28s  -> %s\n", "", source.remedy.c_str());
    }
  }
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

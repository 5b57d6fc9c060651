#include "app/cli/source_kinds.hpp"

#include <iterator>
#include <utility>

#include "devices/sim/sim_source.hpp"

namespace armsreach::app {

std::vector<SourceKind> all_source_kinds() {
  std::vector<SourceKind> kinds = real_source_kinds();
  std::vector<SourceKind> simulated = sim_source_kinds();
  kinds.insert(kinds.end(), std::make_move_iterator(simulated.begin()),
               std::make_move_iterator(simulated.end()));
  return kinds;
}

}  // namespace armsreach::app

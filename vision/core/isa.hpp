// Which of the versions of a hot file to call. A file listed with armsreach_isa_levels() is
// compiled once for each level, its functions in namespace ARMSREACH_ISA; the caller chooses at run
// time.
#pragma once

namespace armsreach {

enum class Isa {
  baseline,  // what the whole program is compiled for
  v3,        // x86-64-v3: AVX2
  v4,        // x86-64-v4: AVX-512
};

// The highest level this processor has.
Isa best_isa();

}  // namespace armsreach

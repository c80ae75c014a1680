#include "tests/support/source_folder.h"

namespace locus::test {

std::string source_folder() { return LOCUS_SOURCE_DIR; }

} // namespace locus::test

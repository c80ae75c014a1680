// source_folder: where the sources lie that these tests were built from, without a slash at the end. One compiled file
// knows it, so that the other tests' objects are the same wherever the sources are and ccache serves every checkout.
#pragma once

#include <string>

namespace locus::test {

std::string source_folder();

} // namespace locus::test

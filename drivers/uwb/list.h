// Lists inside the structs of one frame: bounded, without the heap.
#pragma once

#include <boost/container/static_vector.hpp>

namespace locus::uwb {

template <class T, std::size_t capacity>
using List = boost::container::static_vector<T, capacity>;

} // namespace locus::uwb

// Returns the pairs of elements that adjoin, across the edges between facets too.
//
//   |c_a - c_b| <= 1.1 (l_a + l_b)   and   n_a . n_b > -1/2        c: centres, l: longest edges (m), n: normals
//
// One element between two does not part them: photos often do not show those along an edge. Faces of a thin plate do not adjoin. Parts of one facet that lie apart are joined by a pair, for one plane is mostly
// of one paint. Pairs are of places in `elements`, which are indices into patches.elements.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_ADJOINING_ELEMENTS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_ADJOINING_ELEMENTS_H_

#include <utility>
#include <vector>

#include "forward/room/patches.h"

namespace luxfit {

std::vector<std::pair<int, int>> AdjoiningElements(const Patches& patches, const std::vector<int>& elements);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_ADJOINING_ELEMENTS_H_

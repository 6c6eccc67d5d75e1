// Holds what views show of a rectangular facet, in cells.
//
//   ln Y_s(cell) = median of ln Y_s over the views that see the cell               s: state
//   step(a, b)   = median over states of ln Y_s(b) - ln Y_s(a)                     paint is the same in all, light is not
//   apart(cell)  = quantile over views of median over states of |ln Y_s of a view - ln Y_s(cell)|, kAgreeing of the views
//
// A thing before the facet covers other cells in each view, so that views are far apart on the cells behind it.
// Cells are about kPictureCellM wide. Metres, world frame.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACET_PICTURE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACET_PICTURE_H_

#include <cstddef>
#include <vector>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

constexpr double kPictureCellM = 0.025;
constexpr int kLeastViews = 3;
constexpr double kAgreeing = 0.75;

struct FacetPicture {
  int columns = 0, rows = 0, states = 0;  // columns along edge_u, rows along edge_v
  double width_m = 0, height_m = 0;       // of a cell
  std::vector<float> log_luminance;       // rows x columns x states; NaN where no view shows it
  std::vector<float> apart;               // rows x columns; infinite where fewer than kLeastViews show it

  size_t At(int row, int column) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  // NaN where no state is known of both.
  double Step(size_t a, size_t b) const;
};

// `rays`: of the scene that the facet belongs to, with what stands before it.
FacetPicture PictureOf(const Facet& facet, const RayScene& rays, const std::vector<SignatureView>& views);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACET_PICTURE_H_

// Takes into a fit the outlines of luminaires that photos show.
//
// An outline tells place, shape, size and heading where the light hardly does: it belongs to a luminaire
// whose shape is open or has a size. A luminaire given as a point (or by a file of a point) has no outline to
// compare, and a held one needs none.
//
// The seen outline of a luminaire is that of its bright opening only where the model explains it. Halos, lit
// housings and tubes behind a diffuser look otherwise: where half of a luminaire's points lie more than 3
// sigma from the fitted outline, none of them counts. Nor do they where the fitted luminaire has more than ten times the
// area that they enclose: a large rim may pass near the points of a small one.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_OUTLINES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_OUTLINES_H_

#include <optional>
#include <vector>

#include "inverse/choose/internal/choose_model.h"
#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// Returns the outlines of luminaires that were found. `state`: their places, to about 5 cm.
std::vector<LuminaireOutline> OutlinesOf(const RoomObservations& given, const std::vector<bool>& found,
                                         const LightState& state);

// Returns of each luminaire's outlines those that together hold nine tenths of what all of them tell about its place,
// the most telling first taken: enough to compare models. In a hall whose every camera sees every luminaire, rows then
// grow with the luminaires, not with their square. A point of an outline tells a place to distance / px_per_rad, so
// an outline counts with the sum of (px_per_rad / distance)^2.
std::vector<LuminaireOutline> TellingOutlines(const std::vector<LuminaireOutline>& outlines,
                                              const LightState& state);

// Returns the area of a disc's or rectangle's opening, m2; 0 of other shapes.
double OpeningAreaM2(const Luminaire& luminaire);

// Returns the area that photos show of a disc or a rectangle, m2: what its outlines in a view enclose in its plane, the
// median over views. 0 where none shows it from beside its plane.
double ShownAreaM2(const Luminaire& luminaire, const std::vector<LuminaireOutline>& outlines, int index);

// A fitted opening with more times the shown area is not the one that photos show. Blur and halos let it look
// larger; a picture's border and what stands before it hide less than nine tenths of it.
constexpr double kMostTimesShown = 10;

// Turns points whose shape is open into discs of the size that photos show, where that is more than a point's
// blur. Their light did not tell a size; their outlines do. So do discs and rectangles of open shape get that size where
// their light told one far larger. Records it in `choices`.
LightState WithSeenSizes(const std::vector<OpenChoice>& open, const std::vector<LuminaireOutline>& outlines,
                         LightState state, Findings& findings);

// Turns discs whose shape is open into rectangles of their area, where the fit's disc does not explain what
// photos show: the corners of a square lie beside the disc of the same light. Returns nothing where there is
// none.
std::optional<LightState> WithRectangles(const std::vector<OpenChoice>& open, const LightData& data,
                                         const LuminaireFit& fit);

// Keeps of those rectangles the ones whose outlines the fit `squared` explains; the others are discs again,
// as in `fit`. Records those that are kept in `choices`.
LightState WithExplainedRectangles(const LightData& data, const LuminaireFit& fit,
                                   const LuminaireFit& squared, Findings& findings);

// Returns those of `data.outlines` that the fit to `data` explains. Records both in `choices`.
std::vector<LuminaireOutline> ExplainedOutlines(const RoomObservations& given, const LightData& data,
                                                const LuminaireFit& fit, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_OUTLINES_H_

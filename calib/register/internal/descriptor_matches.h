// Matches the SIFT descriptors of two pictures, with COLMAP's defaults for what counts as a match.
//
//   angle(a, b) = acos(a . b / 512^2),   a match: each is the other's nearest, its angle is at most 0.7 rad
//   and at most 0.8 times that to the second nearest, seen from either picture
//
// Every pair of descriptors is compared, in exact arithmetic, so the same pictures give the same matches on
// every machine. COLMAP's own search is approximate, and its random trees take their seed from a generator
// that its other threads share: its matches differ between runs, and with them the poses.
// Source: Lowe (2004), Distinctive image features, section 7.1; COLMAP 3.8, SiftMatchingOptions.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_DESCRIPTOR_MATCHES_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_DESCRIPTOR_MATCHES_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace luxfit {

inline constexpr Eigen::Index kDescriptorSize = 128;

// One descriptor of norm 512 a column, of whole numbers from 0 to 255: single precision holds their products.
using DescriptorColumns = Eigen::Matrix<float, kDescriptorSize, Eigen::Dynamic>;

// Returns the matches in the order of `a`: index in a, index in b, and so on. A descriptor of zeros has none.
std::vector<std::uint32_t> MatchDescriptors(const DescriptorColumns& a, const DescriptorColumns& b);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_DESCRIPTOR_MATCHES_H_

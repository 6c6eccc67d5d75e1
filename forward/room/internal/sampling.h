// Samples integrals: hashes as random numbers, even points of square and disc, cosine-weighted directions.
//
// Sources: Steele, Lea, Flood (2014), "Fast splittable pseudorandom number generators" (SplitMix64); Malley
// (1988); Masset, Bruls, Kerschen (2011), "Partition of the circle in cells of equal area and shape".
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_SAMPLING_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_SAMPLING_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace luxfit {

// Returns a well-mixed hash, which is also the next state of a small random generator.
uint64_t Mix(uint64_t x);
// Returns a number in [0, 1).
inline double UnitFrom(uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1.0p-53; }
double Fraction(double x);

// Steps of the additive recurrence of the generalised golden ratio in four dimensions (x^5 = x + 1). Its
// points modulo 1 fill the unit cube evenly.
inline constexpr double kGoldenSteps[4] = {0.85667488385450287, 0.73389185662660285, 0.62870672103811578,
                                           0.53859725722361166};

// Returns a point of the same recurrence in two dimensions (the plastic number, x^3 = x + 1): point `index`
// from `start`, in the unit square.
Eigen::Vector2d PlasticPoint(double index, const Eigen::Vector2d& start);

// Lifts a point of the unit disc (its radius squared, its angle in turns) to the hemisphere about z: Malley's
// method.
Eigen::Vector3d LiftedFromDisc(double radius2, double turns);

// Returns a frame whose columns are two tangents and the normal.
Eigen::Matrix3d FrameOf(const Eigen::Vector3d& normal);

// Returns the centres of about `count` cells of equal area and shape of the unit disc: squared radius, turns.
std::vector<Eigen::Vector2d> Isocell(int count);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_SAMPLING_H_

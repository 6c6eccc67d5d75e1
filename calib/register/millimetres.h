// Writes a length for messages: in mm, to two digits, without an exponent.
#ifndef LUXFIT_CALIB_REGISTER_MILLIMETRES_H_
#define LUXFIT_CALIB_REGISTER_MILLIMETRES_H_

#include <string>

namespace luxfit {

// Returns "0.25 mm", "4.1 mm", "183 mm"; "an unknown length" where it is not finite.
std::string Millimetres(double length_m);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_MILLIMETRES_H_

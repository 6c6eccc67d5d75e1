// Samples the signature of a place in a view, and compares two signatures.
//
//   a ~ b  where  mean_s (a_s - b_s)^2 / (t^2 + var a_s + var b_s) < 1         over the states that both know
//
// t: tolerance, of ln Y. At least kFewestStates of them, or all where there are fewer.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_SIGNATURE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_SIGNATURE_H_

#include <cstdint>
#include <vector>

#include "inverse/furniture/signature_view.h"

namespace luxfit {

constexpr int kFewestStates = 3;
constexpr int kMostViews = 64;  // bits of a set of views

// Holds the signatures of one place in several views, in a row of `states` numbers each.
class Signatures {
 public:
  explicit Signatures(int states) : states_(states) {}

  void Clear() { value_.clear(), variance_.clear(); }
  int count() const { return static_cast<int>(value_.size()) / states_; }
  // Samples a pixel of a view, which lies inside. Returns false, and adds nothing, where too few states are known.
  bool Add(const SignatureView& view, double u, double v);
  void DropLast();
  bool Agree(int a, int b, double tolerance) const;
  // Returns the mean that Agree compares with 1; NaN where both know too few states.
  double Difference(int a, int b, double tolerance) const;
  // Returns those that agree with the one with which most agree, as bits. At most kMostViews are compared.
  std::uint64_t LargestAgreement(double tolerance) const;

 private:
  int FewestStates() const { return states_ < kFewestStates ? states_ : kFewestStates; }

  int states_;
  std::vector<float> value_, variance_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_SIGNATURE_H_

#include "calib/register/internal/descriptor_matches.h"

#include <cblas.h>

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr double kMaxAngle = 0.7, kMaxAngleRatio = 0.8;

// Holds the two nearest descriptors of another picture; a larger product is a smaller angle.
struct Nearest {
  Eigen::Index index = -1;
  float product = -1, second_product = -1;

  void Offer(Eigen::Index at, float value) {
    if (value <= second_product) return;
    if (value > product) {
      second_product = product;
      product = value;
      index = at;
    } else {
      second_product = value;
    }
  }
  bool IsClear() const {
    const double angle = Angle(product);
    return index >= 0 && angle <= kMaxAngle &&
           (second_product < 0 || angle < kMaxAngleRatio * Angle(second_product));
  }

 private:
  static double Angle(float product) {
    constexpr double kSquaredNorm = 512.0 * 512.0;
    return std::acos(std::min(1.0, product / kSquaredNorm));
  }
};

}  // namespace

std::vector<std::uint32_t> MatchDescriptors(const DescriptorColumns& a, const DescriptorColumns& b) {
  // Pairs of pictures share the processors; threads of OpenBLAS's own would only wait for each other.
  openblas_set_num_threads(1);
  constexpr Eigen::Index kBlock = 64;
  std::vector<Nearest> of_a(static_cast<std::size_t>(a.cols())), of_b(static_cast<std::size_t>(b.cols()));
  Eigen::MatrixXf products(b.cols(), kBlock);
  for (Eigen::Index from = 0; from < a.cols() && b.cols() > 0; from += kBlock) {
    const Eigen::Index count = std::min(kBlock, a.cols() - from);
    cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, static_cast<int>(b.cols()), static_cast<int>(count),
                static_cast<int>(kDescriptorSize), 1.0F, b.data(), static_cast<int>(kDescriptorSize),
                a.col(from).data(), static_cast<int>(kDescriptorSize), 0.0F, products.data(),
                static_cast<int>(products.rows()));
    for (Eigen::Index i = 0; i < count; ++i) {
      Nearest& nearest = of_a[static_cast<std::size_t>(from + i)];
      for (Eigen::Index j = 0; j < b.cols(); ++j) {
        const float product = products(j, i);
        nearest.Offer(j, product);
        of_b[static_cast<std::size_t>(j)].Offer(from + i, product);
      }
    }
  }
  std::vector<std::uint32_t> matches;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!of_a[i].IsClear()) continue;
    const Nearest& back = of_b[static_cast<std::size_t>(of_a[i].index)];
    if (!back.IsClear() || back.index != static_cast<Eigen::Index>(i)) continue;
    matches.push_back(static_cast<std::uint32_t>(i));
    matches.push_back(static_cast<std::uint32_t>(of_a[i].index));
  }
  return matches;
}

}  // namespace luxfit

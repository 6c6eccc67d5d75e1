#include "forward/radiosity/internal/sparse_transport.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/factors/internal/ray_rows.h"

namespace luxfit {
namespace {

constexpr size_t kSparseRowsPerTask = 256;

using Entry = SparseTransport::Pair;

// Adds up entries of equal column; returns how many are left.
template <typename Iterator>
Iterator SortAndMerge(Iterator begin, Iterator end) {
  std::sort(begin, end, [](const auto& a, const auto& b) { return a.column < b.column; });
  Iterator last = begin;
  for (Iterator it = begin; it != end; ++it) {
    if (it == begin) continue;
    if (it->column == last->column) {
      last->value += it->value;
    } else {
      *++last = *it;
    }
  }
  return begin == end ? begin : last + 1;
}

// Returns row `patch` of F; tallies by element.
std::vector<Entry> CastRow(const RayRows& rays, const Patches& patches, size_t patch_index,
                           std::vector<RayTally>& tallies) {
  const Patch& patch = patches.patches[patch_index];
  std::vector<Entry> row;
  for (int e = patch.first_element; e < patch.first_element + patch.element_count; ++e) {
    const Element& element = patches.elements[static_cast<size_t>(e)];
    const size_t before = row.size();
    const RayTally tally = rays.Cast(element, static_cast<uint64_t>(e), [&row](int hit, float weight) {
      row.push_back({hit, weight});
    });
    tallies[static_cast<size_t>(e)] = tally;
    const float share = static_cast<float>(element.area_m2 / patch.area_m2 * tally.scale);
    for (size_t k = before; k < row.size(); ++k) row[k].value *= share;
  }
  row.erase(SortAndMerge(row.begin(), row.end()), row.end());
  row.shrink_to_fit();
  return row;
}

}  // namespace

SparseTransport::SparseTransport(const RayScene& rays, const Patches& patches,
                                 const FormFactorOptions& options) {
  if (options.rays_per_element < 1)
    throw std::invalid_argument("SparseTransport: expected rays_per_element >= 1");
  const size_t n = patches.patches.size();
  const RayRows caster(rays, patches, FormFactorMethod::kMalley, options.rays_per_element);
  std::vector<std::vector<Entry>> rows(n);
  std::vector<RayTally> tallies(patches.elements.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, n, kSparseRowsPerTask),
                    [&](const tbb::blocked_range<size_t>& range) {
                      for (size_t i = range.begin(); i < range.end(); ++i)
                        rows[i] = CastRow(caster, patches, i, tallies);
                    });
  const RayTally all = Summarise(tallies);
  escaped_fraction_ = all.escaped;
  back_fraction_ = all.back;
  rays_ = all.rays;
  // Each entry goes into its row and, transposed, into its column's.
  row_start_.assign(n + 1, 0);
  for (size_t i = 0; i < n; ++i) {
    row_start_[i + 1] += static_cast<int64_t>(rows[i].size());
    for (const Entry& entry : rows[i]) ++row_start_[static_cast<size_t>(entry.column) + 1];
  }
  for (size_t i = 0; i < n; ++i) row_start_[i + 1] += row_start_[i];
  pairs_.resize(static_cast<size_t>(row_start_[n]));
  std::vector<int64_t> next(row_start_.begin(), row_start_.end() - 1);
  for (size_t i = 0; i < n; ++i) {
    for (const Entry& entry : rows[i]) {
      const size_t j = static_cast<size_t>(entry.column);
      const double ratio = patches.patches[i].area_m2 / patches.patches[j].area_m2;
      const float half = 0.5f * static_cast<float>(std::sqrt(ratio)) * entry.value;
      pairs_[static_cast<size_t>(next[i]++)] = {entry.column, half};
      pairs_[static_cast<size_t>(next[j]++)] = {static_cast<int32_t>(i), half};
    }
    std::vector<Entry>().swap(rows[i]);
  }
  // Pairs that rays found from both ends become one; then the rows close up.
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, n, kSparseRowsPerTask), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i)
          next[i] = SortAndMerge(pairs_.begin() + row_start_[i], pairs_.begin() + next[i]) - pairs_.begin();
      });
  int64_t end = 0;
  for (size_t i = 0; i < n; ++i) {
    const int64_t begin = row_start_[i];
    row_start_[i] = end;
    end = std::copy(pairs_.begin() + begin, pairs_.begin() + next[i], pairs_.begin() + end) - pairs_.begin();
  }
  row_start_[n] = end;
  pairs_.resize(static_cast<size_t>(end));
}

Eigen::MatrixXf SparseTransport::RowsTimes(Eigen::Index first, Eigen::Index count,
                                           const Eigen::MatrixXf& x) const {
  Eigen::MatrixXf product(count, x.cols());
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, count, kSparseRowsPerTask),
                    [&](const tbb::blocked_range<Eigen::Index>& range) {
                      for (Eigen::Index c = 0; c < x.cols(); ++c) {
                        const float* const column = x.col(c).data();
                        for (Eigen::Index k = range.begin(); k < range.end(); ++k) {
                          const size_t i = static_cast<size_t>(first + k);
                          double sum = 0;
                          for (int64_t p = row_start_[i]; p < row_start_[i + 1]; ++p) {
                            const Pair& pair = pairs_[static_cast<size_t>(p)];
                            sum += static_cast<double>(pair.value * column[pair.column]);
                          }
                          product(k, c) = static_cast<float>(sum);
                        }
                      }
                    });
  return product;
}

Eigen::MatrixXf SparseTransport::DiagonalBlock(Eigen::Index first, Eigen::Index count) const {
  Eigen::MatrixXf block = Eigen::MatrixXf::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const size_t i = static_cast<size_t>(first + k);
    for (int64_t p = row_start_[i]; p < row_start_[i + 1]; ++p) {
      const Pair& pair = pairs_[static_cast<size_t>(p)];
      if (pair.column >= first && pair.column < first + count) block(k, pair.column - first) = pair.value;
    }
  }
  return block;
}

void SparseTransport::AddColumn(Eigen::Index i, float factor, Eigen::Ref<Eigen::VectorXf> y) const {
  for (int64_t p = row_start_[static_cast<size_t>(i)]; p < row_start_[static_cast<size_t>(i) + 1]; ++p) {
    const Pair& pair = pairs_[static_cast<size_t>(p)];
    y[pair.column] += factor * pair.value;
  }
}

Eigen::VectorXf PatchAreas(const Patches& patches) {
  Eigen::VectorXf areas(static_cast<Eigen::Index>(patches.patches.size()));
  for (size_t i = 0; i < patches.patches.size(); ++i)
    areas[static_cast<Eigen::Index>(i)] = static_cast<float>(patches.patches[i].area_m2);
  return areas;
}

std::vector<int> PatchMaterials(const Patches& patches) {
  std::vector<int> materials;
  for (const Patch& patch : patches.patches) materials.push_back(patch.material);
  return materials;
}

}  // namespace luxfit

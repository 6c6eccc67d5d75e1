// Solves by progressive shooting with the ambient term.
#include <tbb/parallel_for.h>

#include <cmath>

#include "forward/radiosity/internal/radiosity_system.h"

namespace luxfit {
namespace {

struct Column {
  Eigen::VectorXf scaled_exitance;
  int shots = 0;
};

// The residual of the light that has been shot is exactly the light that has not: rho v, v = sqrt(A) times
// light received and not yet passed on.
Column ShootColumn(const RadiositySystem& system, Eigen::Index c) {
  const Eigen::Index n = system.patches();
  Column column{Eigen::VectorXf::Zero(n), 0};
  Eigen::VectorXf unshot = system.source.col(c);
  while (column.shots < system.max_iterations) {
    Eigen::Index shooter = 0;
    float most_flux = -1, largest_exitance = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const float scaled = std::abs(system.rho[i] * unshot[i]);
      largest_exitance = std::max(largest_exitance, scaled / system.root_area[i]);
      if (const float flux = scaled * system.root_area[i]; flux > most_flux) {
        most_flux = flux;
        shooter = i;
      }
    }
    if (largest_exitance <= system.allowed[c]) break;
    const float shot = system.rho[shooter] * unshot[shooter];
    unshot[shooter] = 0;
    column.scaled_exitance[shooter] += shot;
    system.coupling.AddColumn(shooter, shot, unshot);
    ++column.shots;
  }
  // Cohen et al. (1988), eq. 6 to 8: the unshot light is spread evenly with all its further reflections.
  const Eigen::VectorXf area = system.root_area.cwiseAbs2();
  const Eigen::VectorXf left = system.rho.cwiseProduct(unshot);
  const float mean_rho = area.dot(system.rho) / area.sum();
  const float ambient_lx = left.dot(system.root_area) / area.sum() / (1 - mean_rho);
  column.scaled_exitance += left + ambient_lx * system.rho.cwiseProduct(system.root_area);
  return column;
}

}  // namespace

RadiosityIterate SolveShooting(const RadiositySystem& system) {
  RadiosityIterate iterate{Eigen::MatrixXf(system.patches(), system.columns()), 0};
  std::vector<int> shots(static_cast<size_t>(system.columns()));
  tbb::parallel_for(Eigen::Index{0}, system.columns(), [&](Eigen::Index c) {
    const Column column = ShootColumn(system, c);
    iterate.scaled_exitance.col(c) = column.scaled_exitance;
    shots[static_cast<size_t>(c)] = column.shots;
  });
  for (const int count : shots) iterate.iterations = std::max(iterate.iterations, count);
  return iterate;
}

}  // namespace luxfit

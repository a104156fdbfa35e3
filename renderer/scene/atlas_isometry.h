#pragma once

#include "renderer/scene/atlas_planar_solver.h"
#include "renderer/scene/atlas_rest_shape.h"

#include <vector>

/// Descent to maps as near to isometry as a chart allows.
namespace celadon::atlas {

/// Local/global iterations of as-rigid-as-possible parametrization (Liu et al. 2008, "A
/// local/global approach to mesh parameterization", eqs. 3-6). Quick and free of parameters, but
/// triangles may turn over.
/// @return mean of (s1 - 1)^2 + (s2 - 1)^2 over the area, s1 and s2 the singular values, before the
///         last iteration; iteration ends early where that is hopelessly above `tolerance`
/// @param solver of laplacian(mesh, rest)
double relaxRigid(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                  const PlanarSolver& solver, int maxIterations, double tolerance, Planar& uv);

/// Minimizes the symmetric Dirichlet energy sum A (|J|^2 + |J^-1|^2) (Smith and Schaefer 2015,
/// "Bijective parameterization with free boundaries", eq. 1), which weighs shrinking and stretching
/// alike and is infinite for a triangle about to turn over; every step stays short of that. L-BFGS
/// over the Laplacian as the metric.
/// @param leastGain stop when an iteration lowers the energy by a smaller part than this
/// @param uv        every triangle is positively oriented, before and after
void relaxSymmetric(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                    const PlanarSolver& solver, int maxIterations, double leastGain, Planar& uv);

/// Every triangle has a positive area, by a margin above rounding.
[[nodiscard]] bool isOriented(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                              const Planar& uv);

} // namespace celadon::atlas

#pragma once

#include <cstdint>

/// Rounding of a profile to half precision that keeps its diffuse albedo.
namespace celadon::subedit {

/// Rounds the knots of one texel to halves. Half precision has steps of 0.4 % to 1.6 % in P; each
/// rounded alone would bend the albedo by as much. A common shift smaller than a step would be lost
/// in the rounding again, so instead single knots are rounded the other way until the energy is
/// kept (error below 1e-3 for n >= 8).
/// @param logProfile (segments + 1) x 3 values of ln P, channel fastest, within [-30, 40]
/// @param halves     as many bit patterns of IEEE half precision
void roundKeepingAlbedo(const float* logProfile, int segments, std::uint16_t* halves);

} // namespace celadon::subedit

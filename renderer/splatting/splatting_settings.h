#pragma once

/// Options of the splatting solver (DESIGN sections 3 and 5), with the defaults of the command line.
namespace celadon {

enum class Scheme { Paper, Hierarchical };

struct SplattingSettings {
    Scheme scheme = Scheme::Paper;
    int irradianceSize = 512;  ///< N, texels on a side of the irradiance buffer
    int irradianceLevels = 6;  ///< 1: level 0 only
    int splattingLevels = 5;   ///< 1: full resolution only
    double alpha = 15.0;       ///< eq. 11
    double epsilon = 0.01;     ///< eq. 14
    double discontinuity = 0.03; ///< z_0 in bounding sphere radii, eq. 10
    double energy = 0.99;      ///< R_cut holds this fraction; 1: R_cut = r_s
    bool adaptive = true;      ///< off: every lit level-0 texel is a sample
    bool multiresolution = true; ///< off: every splat at full resolution
};

} // namespace celadon

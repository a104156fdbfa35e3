#pragma once

#include <vector>

/// Options of the splatting solver (DESIGN sections 3 and 5), with the defaults of the command
/// line.
namespace celadon {

enum class Scheme {
    Paper,       ///< Chen et al. 2012 with its slips mended
    Hierarchical ///< both pyramids at every distance, cross-faded
};

/// What adds up the pairs; all of one meaning.
enum class SplatBackendKind {
    Auto,   ///< cpu where the driver is software, else the faster of raster and tiled, as measured
    Raster, ///< geometry shader and blending, the paper's
    Tiled,  ///< tiles gather in a compute shader
    Cpu     ///< tiles gather on the processor; for software drivers, where a read-back is a copy
};

/// Of a light view, that R_P spans: below, the texels themselves begin to show, as a lattice.
inline constexpr double kLatticeTexels = 3.75;

struct SplattingSettings {
    Scheme scheme = Scheme::Paper;
    SplatBackendKind backend = SplatBackendKind::Auto;
    int irradianceSize = 512; ///< N, texels on a side of the irradiance buffer
    /// N is doubled where R_P spans fewer texels than the one, for silhouettes and shadows of the
    /// light view, and again where fewer than the other, since texels show; 0: it stays.
    double fineBelowTexels = 0.0;
    double finerBelowTexels = 0.0;
    /// N as it is asked for, whatever R_P.
    void fixIrradianceSize(int size) {
        irradianceSize = size;
        fineBelowTexels = finerBelowTexels = 0.0;
    }
    /// Of a texel's patch, over that of a texel lit evenly. With 1, patches wider than the core of
    /// a profile leave a comb between them, seen as a lattice of dots; with 2 a fifth of it, and
    /// edges of shadows that are softer by a tenth of a texel.
    double patchVariance = 1.0;
    int irradianceLevels = 6; ///< 1: level 0 only
    int splattingLevels = 5;  ///< 1: full resolution only
    double alpha = 15.0;      ///< eq. 11
    double epsilon = 0.01;    ///< eq. 14
    /// Rbar over log2 T as MaterialTables has it, for all materials; empty: computed from each.
    std::vector<float> rangeTable{};
    double discontinuity = 0.03; ///< z_0 in bounding sphere radii, eq. 10
    bool orientation = true;     ///< off: eq. 11 without |n . l|, to see what it is for
    /// R_cut holds this fraction; 1: R_cut = r_s. What it cuts off is given to what it keeps, as on
    /// a plane: with 0.99 long ranges come 0.3 to 0.4 % too bright on small objects, which the cut
    /// light would have missed.
    double energy = 0.995;
    bool adaptive = true;        ///< off: every lit level-0 texel is a sample
    bool multiresolution = true; ///< off: every splat at full resolution
    // Hierarchical scheme.
    double sampleAngle = 1.8; ///< theta_s: spread of a node over the distance it is used from
    double pixelAngle = 0.2;  ///< theta_p: pixel of a level over the distance where its ring begins
    double fade = 0.6;        ///< b: width of the cross-fade about a ball, in ball radii
    double fineSpread = 0.06; ///< beta: a node this small for its shortest R_P needs no ball
};

} // namespace celadon

// Layouts of the uniform blocks, read by GLSL and C++ alike (renderer/gpu_blocks.h): only mat4, vec4
// and ivec4 members, so that std140 and C++ agree.

// The camera and the frame. Lengths in mm, pixel rows from the bottom.
struct FrameBlock {
    mat4 view;           // world mm -> view, -z forward
    mat4 viewProjection; // reverse z, clip range 0..1
    vec4 eye;            // xyz; w: 1 perspective, 0 orthographic
    vec4 forward;        // unit view direction; 0
    vec4 frameSize;      // W, H, padded W, padded H of level 0
    vec4 projection;     // P00, P11 of the projection; pixel width in mm at depth z is z * third + fourth
};

// What there is to see, in mm: center and radius. Written by the GPU where the shape moves.
struct BoundsBlock {
    vec4 scattering; // over scattering meshes; its diameter is R_w
    vec4 scene;      // over everything
};

// One light view: a frustum from which the irradiance buffer is drawn.
struct LightBlock {
    mat4 view;
    mat4 viewProjection;
    vec4 position;  // xyz mm; w: 1 for point and spot, 0 for directional
    vec4 direction; // unit, along which light travels; w: edge of the square of texels, N; 0: a view not in use
    vec4 color;     // irradiance [W/m^2] or radiant intensity [W/sr]; w: 1 spot
    vec4 cone;      // cos inner, cos outer; texel width in mm at depth z is z * third + fourth
};

// Scattering materials: one element each.
struct MaterialEntry {
    vec4 profile; // r_s [mm], segments n, eta, 1 / c of the exit Fresnel term (DESIGN 1)
    vec4 place;   // in the array of all materials: uv (0,0), and how far uv (1,1) is from it
    vec4 layers;  // first layer, 0, 0, 0
};

// Settings of one solve (DESIGN 3).
struct SolveBlock {
    vec4 selection; // alpha, z_0 in bounding sphere radii, 0, 1: eq. 11 has |n . l|
    vec4 node;      // node profiles: r_s [mm], segments n; theta_s, beta (hierarchical)
    vec4 rings;     // levels of the splatting buffer, levels of the irradiance buffer, theta_p, b (hierarchical)
    vec4 energy;    // 1: give back what the cut leaves out; 1: adaptive; 1: multiresolution; R_cut is r_s
};

#include "include/solve.glsl"

// A sample at one level of the splatting buffer.
struct Splat {
    vec4 center;      // x_i in mm; variance sigma^2 in mm^2
    vec4 flux;        // 1e-6 W, what lies beyond R_cut given back; steepest initial slope of -ln P in 1/mm
    vec3 diagonal;    // of the covariance, mm^2
    vec3 offDiagonal; // xy, xz, yz
    vec3 ring;        // paper: distances [low, high) in mm, 0; hierarchical: R^k, R^(k+1) or 0, own ball
    vec4 parent;      // hierarchical: the parent's position and ball, 1e30: none
    vec3 texture_;    // own profile of the material: u, v, material; else: its texel, material
};

#ifdef HIERARCHICAL
// 0 inside the ball, 1 well outside: where the node may stand for its children.
float outside(float ball, float d) {
    return ball > 0.0 ? smoothstep(ball, (1.0 + solve.rings.w) * ball, d) : 1.0;
}

// Weight of the node's part W = a_node (1 - a_parent) times that of ring k, h_k - h_(k+1), for a pixel at
// distance d. Over all nodes above a texel and all rings these sum to one at every distance.
float ringWeight(vec3 position, float d, vec3 ring, vec4 parent) {
    float w = outside(ring.z, d);
    if (parent.w < 1e29) {
        w *= 1.0 - outside(parent.w, distance(position, parent.xyz));
    }
    if (ring.x > 0.0) {
        w *= smoothstep(0.8 * ring.x, 1.2 * ring.x, d);
    }
    if (ring.y > 0.0) {
        w *= 1.0 - smoothstep(0.8 * ring.y, 1.2 * ring.y, d);
    }
    return w;
}
#else
// Hard rings: [low, high).
float ringWeight(vec3 position, float d, vec3 ring, vec4 parent) { return d >= ring.x && d < ring.y ? 1.0 : 0.0; }
#endif

// Adaptive selection (Chen et al. 2012, eqs. 10 and 11, Algorithm 1): a vertex a node of one level of the
// irradiance buffer. The printed test is inverted and looks one level up only; here a node is
// selected when it is fit, or at level 0, and no ancestor of it is selected (DESIGN 3.2). An
// ancestor is selected somewhere along the chain exactly when some ancestor is fit.
//
// HIERARCHICAL: a node takes part between its own ball and its parent's (node_ball.comp). Where that
// touches the ring of the splatting level in question it is selected.
#include "include/fit.glsl"
#include "include/rings.glsl"

layout(location = 0) uniform ivec3 levelAndWidth; // level, texels in a row of it, splatting level (-1: any)

layout(binding = 5) uniform sampler2D balls;

flat out int selectedNode; // -1: not selected

// Whether the node has weight at some distance within r_s, and within the ring asked for.
bool takesPart(ivec2 node, int level, int k) {
    float ball = texelFetch(balls, node, level).r;
    float r_s = solve.node.x;
    if (ball >= r_s) {
        return false;
    }
    vec3 position = texelFetch(positions, node, level).xyz;
    float reach = r_s;
    if (level + 1 < irradianceLevels()) {
        float parentBall = texelFetch(balls, node / 2, level + 1).r;
        if (parentBall <= 0.0) {
            return false; // the parent stands for it everywhere
        }
        float offset = distance(texelFetch(positions, node / 2, level + 1).xyz, position);
        reach = min(reach, (1.0 + solve.rings.w) * parentBall + offset);
    }
    if (k < 0) {
        return true;
    }
    float depth = max(-(frame.view * vec4(position, 1.0)).z, 1e-3);
    return 0.8 * ringRadius(k, depth) < reach && ringRadius(k, depth) < r_s &&
           (!hasNextRing(k, depth) || 1.2 * ringRadius(k + 1, depth) > ball);
}

void main() {
    int level = levelAndWidth.x;
    ivec2 node = ivec2(gl_VertexID % levelAndWidth.y, gl_VertexID / levelAndWidth.y);
    selectedNode = -1;
    gl_Position = vec4(0.0);
    if (!isLit(node, level)) {
        return;
    }
#ifdef HIERARCHICAL
    bool selected = takesPart(node, level, levelAndWidth.z);
#else
    bool selected = level == 0 || (isAdaptive() && isFit(node, level));
    for (int k = level + 1; selected && isAdaptive() && k < irradianceLevels(); ++k) {
        selected = !isFit(node >> (k - level), k);
    }
#endif
    if (selected) {
        selectedNode = gl_VertexID;
    }
}

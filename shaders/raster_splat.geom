// A splat's rectangle, two triangles (Chen et al. 2012, "hardware implementation").
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

in SplatPoint {
    flat vec4 rectangle;
    flat vec4 center;
    flat vec4 flux;
    flat vec3 diagonal;
    flat vec3 offDiagonal;
    flat vec3 ring;
    flat vec4 parent;
    flat vec3 texture_;
} point[];

flat out vec4 center;
flat out vec4 flux;
flat out vec3 diagonal;
flat out vec3 offDiagonal;
flat out vec3 ring;
#ifdef HIERARCHICAL
flat out vec4 parent;
#endif
flat out vec3 nodeTexture;

void main() {
    vec4 r = point[0].rectangle;
    if (r.z <= r.x || r.w <= r.y) {
        return;
    }
    for (int i = 0; i < 4; ++i) {
        gl_Position = vec4((i & 1) == 0 ? r.x : r.z, (i & 2) == 0 ? r.y : r.w, 0.0, 1.0);
        center = point[0].center;
        flux = point[0].flux;
        diagonal = point[0].diagonal;
        offDiagonal = point[0].offDiagonal;
        ring = point[0].ring;
#ifdef HIERARCHICAL
        parent = point[0].parent;
#endif
        nodeTexture = point[0].texture_;
        EmitVertex();
    }
    EndPrimitive();
}

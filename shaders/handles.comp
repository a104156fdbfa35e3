// Moves the rest shape of one mesh by the nodes that handles move, before skins and deformers: the pair of
// renderer/scene/node_blend.cpp. Writes position, normal and miter of each drawn vertex, in the space of its binding.
#include "include/vertex_pose.glsl"
#include "include/list_group.glsl"

layout(location = 0) uniform ivec4 counts; // vertices; influences each, 0: one matrix for all; 0; flags

struct VertexNodes {
    float at[3]; // at rest, mm
    uint nodes[13]; // kNoNode beyond those that it follows
};
struct Node {
    vec4 place; // at rest, mm
    vec4 to;
    vec4 linear[3];
};

layout(std430, binding = 4) restrict writeonly buffer Moved { float moved[]; }; // 9 each
layout(std430, binding = 5) restrict readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 6) restrict readonly buffer Miters { float miters[]; };
layout(std430, binding = 7) restrict readonly buffer Vertices { VertexNodes vertices[]; };

const uint kNoNode = 0xffffffffu;

mat3 linearOf(Node node) {
    return mat3(node.linear[0].xyz, node.linear[1].xyz, node.linear[2].xyz);
}

// How far a vertex moves, and the derivative of where it goes by its place at rest.
vec3 followNodes(VertexNodes vertex, vec3 p, out mat3 jacobian) {
    jacobian = mat3(1.0);
    if (vertex.nodes[0] == kNoNode) {
        return vec3(0.0);
    }
    Node first = nodes[vertex.nodes[0]];
    vec3 firstMoves = first.to.xyz - p + linearOf(first) * (p - first.place.xyz);
    if (vertex.nodes[1] == kNoNode) {
        jacobian = linearOf(first);
        return firstMoves;
    }
    int last = 1;
    while (last < 12 && vertex.nodes[last + 1] != kNoNode) {
        ++last;
    }
    vec3 toLast = p - nodes[vertex.nodes[last]].place.xyz;
    float D2 = dot(toLast, toLast);
    float sum = 0.0;
    vec3 sumSlope = vec3(0.0);
    vec3 moves = vec3(0.0);
    mat3 linear = mat3(0.0);
    mat3 swept = mat3(0.0);
    for (int k = 0; k < last; ++k) {
        Node node = nodes[vertex.nodes[k]];
        vec3 to = p - node.place.xyz;
        float d2 = dot(to, to);
        float remains = 1.0 - d2 / D2;
        float w = remains * remains;
        vec3 slope = 4.0 * remains / D2 * (d2 / D2 * toLast - to);
        vec3 x = node.to.xyz - p + linearOf(node) * to;
        sum += w;
        sumSlope += slope;
        moves += w * x;
        linear += w * linearOf(node);
        swept += outerProduct(x, slope);
    }
    if (!(sum > 1e-9)) {
        jacobian = linearOf(first);
        return firstMoves;
    }
    moves /= sum;
    jacobian = (linear + swept - outerProduct(moves, sumSlope)) / sum;
    return moves;
}

void main() {
    int i = listIndex();
    if (i >= counts.x) {
        return;
    }
    int source = (counts.w & kHasMap) != 0 ? int(map[i]) : i;
    vec3 position = vec3(bound[6 * source], bound[6 * source + 1], bound[6 * source + 2]);
    vec3 normal = vec3(bound[6 * source + 3], bound[6 * source + 4], bound[6 * source + 5]);
    vec3 miter = (counts.w & kHasMiters) != 0 ? vec3(miters[3 * i], miters[3 * i + 1], miters[3 * i + 2]) : vec3(0.0);
    vec3 p = vec3(vertices[i].at[0], vertices[i].at[1], vertices[i].at[2]);
    mat3 jacobian;
    vec3 moves = followNodes(vertices[i], p, jacobian);
    mat4 toRest = matrixOf(source, counts.y);
    mat3 bend = mat3(toRest);
    if (determinant(bend) != 0.0) {
        // In the space of the binding: what it does there is R^-1 (J R b + moves + (J - 1) (t - p)), R and t to rest.
        mat3 back = inverse(bend);
        vec3 atRest = (toRest * vec4(position, 1.0)).xyz;
        position += back * (moves + (jacobian - mat3(1.0)) * (atRest - p));
        mat3 carrier = cofactors(back * jacobian * bend);
        normal = directionOr(carrier * normal, vec3(0.0));
        miter = length(miter) * directionOr(carrier * miter, vec3(0.0));
    }
    for (int k = 0; k < 3; ++k) {
        moved[9 * i + k] = position[k];
        moved[9 * i + 3 + k] = normal[k];
        moved[9 * i + 6 + k] = miter[k];
    }
}

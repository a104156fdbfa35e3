// Moves the rest shape of one mesh by the nodes that handles move, before skins and deformers: the pair of
// renderer/scene/node_blend.cpp. Writes position, normal and miter of each drawn vertex, in the space of its binding.
#include "include/vertex_pose.glsl"
#include "include/list_group.glsl"

layout(location = 0) uniform ivec4 counts; // vertices; influences each, 0: one matrix for all; 0; flags

struct Node {
    vec3 place; // at rest, mm
    vec3 to;
    mat3 linear;
};

layout(std430, binding = 4) restrict writeonly buffer Moved { float moved[]; }; // 9 each
layout(std430, binding = 6) restrict readonly buffer Miters { float miters[]; };
layout(binding = 1) uniform samplerBuffer nodes;        // as Node, a texel a column
layout(binding = 2) uniform usamplerBuffer vertexNodes; // place at rest, mm; 13 nodes, kNoNode beyond those that it follows

const uint kNoNode = 0xffffffffu;

uint nodeOf(int vertex, int k) {
    return texelFetch(vertexNodes, 16 * vertex + 3 + k).r;
}

vec3 placeOf(int vertex) {
    return uintBitsToFloat(uvec3(texelFetch(vertexNodes, 16 * vertex).r, texelFetch(vertexNodes, 16 * vertex + 1).r,
                                 texelFetch(vertexNodes, 16 * vertex + 2).r));
}

Node nodeAt(uint index) {
    int at = 5 * int(index);
    return Node(texelFetch(nodes, at).xyz, texelFetch(nodes, at + 1).xyz,
                mat3(texelFetch(nodes, at + 2).xyz, texelFetch(nodes, at + 3).xyz, texelFetch(nodes, at + 4).xyz));
}

// How far a vertex moves, and the derivative of where it goes by its place at rest.
vec3 followNodes(int vertex, vec3 p, out mat3 jacobian) {
    jacobian = mat3(1.0);
    if (nodeOf(vertex, 0) == kNoNode) {
        return vec3(0.0);
    }
    Node first = nodeAt(nodeOf(vertex, 0));
    vec3 firstMoves = first.to - p + first.linear * (p - first.place);
    if (nodeOf(vertex, 1) == kNoNode) {
        jacobian = first.linear;
        return firstMoves;
    }
    int last = 1;
    while (last < 12 && nodeOf(vertex, last + 1) != kNoNode) {
        ++last;
    }
    vec3 toLast = p - nodeAt(nodeOf(vertex, last)).place;
    float D2 = dot(toLast, toLast);
    float sum = 0.0;
    vec3 sumSlope = vec3(0.0);
    vec3 moves = vec3(0.0);
    mat3 linear = mat3(0.0);
    mat3 swept = mat3(0.0);
    for (int k = 0; k < last; ++k) {
        Node node = nodeAt(nodeOf(vertex, k));
        vec3 to = p - node.place;
        float d2 = dot(to, to);
        float remains = 1.0 - d2 / D2;
        float w = remains * remains;
        vec3 slope = 4.0 * remains / D2 * (d2 / D2 * toLast - to);
        vec3 x = node.to - p + node.linear * to;
        sum += w;
        sumSlope += slope;
        moves += w * x;
        linear += w * node.linear;
        swept += outerProduct(x, slope);
    }
    if (!(sum > 1e-9)) {
        jacobian = first.linear;
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
    mat3 jacobian;
    vec3 p = placeOf(i);
    vec3 moves = followNodes(i, p, jacobian);
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

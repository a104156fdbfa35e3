// Bends of space (Barr 1984) and lattices, as in renderer/scene/deformer.cpp, of which this is the pair: keep both. After
// include/vertex_pose.glsl.
#include "include/lattice.glsl"

struct Deformer {
    ivec4 kind;    // 0 twist, 1 bend, 2 taper, 3 wave, 4 inflate, 5 lattice, 6 nothing; axis, 0, 0
    ivec4 lattice; // control points along x, y, z; the first of its offsets
    vec4 center;   // of the rest box, mm; lattice: 1 / its extent
    vec4 amount;   // radians per mm, scale less 1 per mm, or mm; wave: radians per mm; low end, 0; lattice: low corner
    vec4 bounds;   // of the distance from the low end within which it grows, mm; 0, 0
};

const int kTwist = 0;
const int kBend = 1;
const int kTaper = 2;
const int kWave = 3;
const int kInflate = 4;
const int kLattice = 5;

// Within half a turn: drivers are inexact far from there.
float reducedAngle(float angle) {
    const float kTwoPi = 6.28318530717958647692;
    return angle - kTwoPi * round(angle / kTwoPi);
}

vec3 mapAlongAxis(Deformer deformer, vec3 p, out mat3 jacobian) {
    int a = deformer.kind.y;
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    float distance = p[a] - deformer.amount.z;
    float s = clamp(distance, deformer.bounds.x, deformer.bounds.y);
    float beyond = distance - s;
    float slope = beyond == 0.0 ? 1.0 : 0.0; // of s
    float u = p[b] - deformer.center[b];
    float v = p[c] - deformer.center[c];
    float rate = deformer.amount.x;
    vec3 position = p;
    jacobian = mat3(1.0);
    if (deformer.kind.x == kTwist) {
        float angle = reducedAngle(rate * s);
        float cosine = cos(angle);
        float sine = sin(angle);
        float turnedU = cosine * u - sine * v;
        float turnedV = sine * u + cosine * v;
        position[b] = deformer.center[b] + turnedU;
        position[c] = deformer.center[c] + turnedV;
        jacobian[a][b] = -slope * rate * turnedV;
        jacobian[a][c] = slope * rate * turnedU;
        jacobian[b][b] = cosine;
        jacobian[c][c] = cosine;
        jacobian[b][c] = sine;
        jacobian[c][b] = -sine;
    } else if (deformer.kind.x == kBend) {
        float angle = rate * s;
        float reduced = reducedAngle(angle);
        float cosine = cos(reduced);
        float sine = sin(reduced);
        float sineOfHalf = sin(0.5 * reduced); // its square is that of the full angle's half
        bool isFlat = abs(angle) < 1e-4;
        float forth = (isFlat ? s : s * sine / angle) + beyond * cosine;
        float across = (isFlat ? 0.5 * s * angle : s * 2.0 * sineOfHalf * sineOfHalf / angle) + beyond * sine;
        position[a] = deformer.amount.z + forth - u * sine;
        position[b] = deformer.center[b] + across + u * cosine;
        jacobian[a][a] = (1.0 - slope * rate * u) * cosine;
        jacobian[a][b] = (1.0 - slope * rate * u) * sine;
        jacobian[b][a] = -sine;
        jacobian[b][b] = cosine;
    } else if (deformer.kind.x == kTaper) {
        float scale = 1.0 + rate * s;
        position[b] = deformer.center[b] + scale * u;
        position[c] = deformer.center[c] + scale * v;
        jacobian[a][b] = slope * rate * u;
        jacobian[a][c] = slope * rate * v;
        jacobian[b][b] = scale;
        jacobian[c][c] = scale;
    } else {
        float angle = reducedAngle(deformer.amount.y * s);
        position[b] += rate * sin(angle);
        jacobian[a][b] = slope * rate * deformer.amount.y * cos(angle);
    }
    return position;
}

void deform(Deformer deformer, inout vec3 position, inout vec3 normal, inout vec3 miter) {
    if (deformer.kind.x > kLattice) {
        return;
    }
    if (deformer.kind.x == kInflate) {
        position += deformer.amount.x * miter;
        return;
    }
    mat3 jacobian;
    if (deformer.kind.x == kLattice) {
        position = mapThroughLattice(deformer.lattice, deformer.amount.xyz, deformer.center.xyz, position, jacobian);
    } else {
        position = mapAlongAxis(deformer, position, jacobian);
    }
    mat3 carrier = cofactors(jacobian);
    normal = directionOr(carrier * normal, normal);
    float size = length(miter);
    if (size > 0.0) {
        miter = size * directionOr(carrier * miter, miter / size);
    }
}

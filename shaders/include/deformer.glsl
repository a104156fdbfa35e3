// Bends of space (Barr 1984) and lattices, as in renderer/scene/deformer.cpp, of which this is the pair: keep both. After
// include/vertex_pose.glsl. LATTICE: with lattices; software drivers follow all branches, and pay for them even where
// there are none.
#include "include/lattice.glsl"

struct Deformer {
    vec4 kind;     // 0 twist, 1 bend, 2 taper, 3 wave, 4 inflate, 5 lattice, 6 nothing; axis, 0, 0
    vec4 lattice;  // control points along x, y, z; the first of its offsets
    vec4 center;   // of the rest box, mm; lattice: 1 / its extent
    vec4 amount;   // radians per mm, scale less 1 per mm, or mm; wave: radians per mm; low end, 0; lattice: low corner
    vec4 bounds;   // of the distance from the low end within which it grows, mm; what counts as its end, mm; 0
};

layout(binding = 1) uniform samplerBuffer deformers; // as Deformer, a texel a member

Deformer deformerAt(int index) {
    int at = 5 * index;
    return Deformer(texelFetch(deformers, at), texelFetch(deformers, at + 1), texelFetch(deformers, at + 2),
                    texelFetch(deformers, at + 3), texelFetch(deformers, at + 4));
}

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

// The axis first, in a cycle; and back.
vec3 fromAxis(int axis, vec3 v) {
    return axis == 0 ? v : (axis == 1 ? v.yzx : v.zxy);
}

vec3 toAxis(int axis, vec3 v) {
    return axis == 0 ? v : (axis == 1 ? v.zxy : v.yzx);
}

// p and center with the axis first; the Jacobian as well.
vec3 mapAlongAxis(Deformer deformer, vec3 center, vec3 p, out mat3 jacobian) {
    int kind = int(deformer.kind.x);
    float distance = p.x - deformer.amount.z;
    float s = clamp(distance, deformer.bounds.x, deformer.bounds.y);
    float beyond = distance - s;
    float slope = abs(beyond) <= deformer.bounds.z ? 1.0 : 0.0; // of s
    float u = p.y - center.y;
    float v = p.z - center.z;
    float rate = deformer.amount.x;
    float angle = (kind == kWave ? deformer.amount.y : rate) * s;
    float reduced = reducedAngle(angle);
    float cosine = cos(reduced);
    float sine = sin(reduced);
    if (kind == kTwist) {
        float turnedU = cosine * u - sine * v;
        float turnedV = sine * u + cosine * v;
        jacobian = mat3(1.0, -slope * rate * turnedV, slope * rate * turnedU, //
                        0.0, cosine, sine,                                    //
                        0.0, -sine, cosine);
        return vec3(p.x, center.y + turnedU, center.z + turnedV);
    }
    if (kind == kBend) {
        float sineOfHalf = sin(0.5 * reduced); // its square is that of the full angle's half
        bool isFlat = abs(angle) < 1e-4;
        float forth = (isFlat ? s : s * sine / angle) + beyond * cosine;
        float across = (isFlat ? 0.5 * s * angle : s * 2.0 * sineOfHalf * sineOfHalf / angle) + beyond * sine;
        float along = 1.0 - slope * rate * u;
        jacobian = mat3(along * cosine, along * sine, 0.0, //
                        -sine, cosine, 0.0,                //
                        0.0, 0.0, 1.0);
        return vec3(deformer.amount.z + forth - u * sine, center.y + across + u * cosine, p.z);
    }
    if (kind == kTaper) {
        float scale = 1.0 + rate * s;
        jacobian = mat3(1.0, slope * rate * u, slope * rate * v, //
                        0.0, scale, 0.0,                         //
                        0.0, 0.0, scale);
        return vec3(p.x, center.y + scale * u, center.z + scale * v);
    }
    jacobian = mat3(1.0, slope * rate * deformer.amount.y * cosine, 0.0, //
                    0.0, 1.0, 0.0,                                       //
                    0.0, 0.0, 1.0);
    return vec3(p.x, p.y + rate * sine, p.z);
}

void deform(Deformer deformer, inout vec3 position, inout vec3 normal, inout vec3 miter) {
    int kind = int(deformer.kind.x);
    if (kind > kLattice) {
        return;
    }
    if (kind == kInflate) {
        position += deformer.amount.x * miter;
        return;
    }
    int axis = int(deformer.kind.y);
    mat3 jacobian;
#ifdef LATTICE
    if (kind == kLattice) {
        axis = 0;
        position = mapThroughLattice(ivec4(deformer.lattice), deformer.amount.xyz, deformer.center.xyz, position, jacobian);
    } else
#endif
    {
        vec3 center = fromAxis(axis, deformer.center.xyz);
        position = toAxis(axis, mapAlongAxis(deformer, center, fromAxis(axis, position), jacobian));
    }
    mat3 carrier = cofactors(jacobian);
    normal = directionOr(toAxis(axis, carrier * fromAxis(axis, normal)), normal);
    float size = length(miter);
    if (size > 0.0) {
        miter = size * directionOr(toAxis(axis, carrier * fromAxis(axis, miter)), miter / size);
    }
}

// Bends of space (Barr 1984), as in renderer/scene/deformer.cpp, of which this is the pair: keep both.
struct Deformer {
    ivec4 kind;  // 0 twist, 1 bend, 2 taper, 3 wave, 4 inflate; axis, 0, 0
    vec4 center; // of the rest box, mm; its length along the axis
    vec4 amount; // radians per mm, scale less 1 per mm, or mm; wave: radians per mm; low end, 0
};

const int kTwist = 0;
const int kBend = 1;
const int kTaper = 2;
const int kWave = 3;
const int kInflate = 4;

// Within half a turn: drivers are inexact far from there.
float reducedAngle(float angle) {
    const float kTwoPi = 6.28318530717958647692;
    return angle - kTwoPi * round(angle / kTwoPi);
}

vec3 directionOr(vec3 v, vec3 otherwise) {
    float squared = dot(v, v);
    return squared > 0.0 && !isinf(squared) ? v * inversesqrt(squared) : otherwise;
}

// Carries normals: the inverse transpose times the determinant.
mat3 cofactors(mat3 m) {
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}

void deform(Deformer deformer, inout vec3 position, inout vec3 normal, inout vec3 miter) {
    if (deformer.kind.x == kInflate) {
        position += deformer.amount.x * miter;
        return;
    }
    int a = deformer.kind.y;
    int b = (a + 1) % 3;
    int c = (a + 2) % 3;
    vec3 p = position;
    float s = p[a] - deformer.amount.z;
    float u = p[b] - deformer.center[b];
    float v = p[c] - deformer.center[c];
    float rate = deformer.amount.x;
    mat3 jacobian = mat3(1.0);
    if (deformer.kind.x == kTwist) {
        float angle = reducedAngle(rate * s);
        float cosine = cos(angle);
        float sine = sin(angle);
        float turnedU = cosine * u - sine * v;
        float turnedV = sine * u + cosine * v;
        position[b] = deformer.center[b] + turnedU;
        position[c] = deformer.center[c] + turnedV;
        jacobian[a][b] = -rate * turnedV;
        jacobian[a][c] = rate * turnedU;
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
        float along = isFlat ? s : s * sine / angle;
        float across = isFlat ? 0.5 * s * angle : s * 2.0 * sineOfHalf * sineOfHalf / angle;
        position[a] = deformer.amount.z + along - u * sine;
        position[b] = deformer.center[b] + across + u * cosine;
        jacobian[a][a] = (1.0 - rate * u) * cosine;
        jacobian[a][b] = (1.0 - rate * u) * sine;
        jacobian[b][a] = -sine;
        jacobian[b][b] = cosine;
    } else if (deformer.kind.x == kTaper) {
        float scale = 1.0 + rate * s;
        position[b] = deformer.center[b] + scale * u;
        position[c] = deformer.center[c] + scale * v;
        jacobian[a][b] = rate * u;
        jacobian[a][c] = rate * v;
        jacobian[b][b] = scale;
        jacobian[c][c] = scale;
    } else {
        float angle = reducedAngle(deformer.amount.y * s);
        position[b] += rate * sin(angle);
        jacobian[a][b] = rate * deformer.amount.y * cos(angle);
    }
    mat3 carrier = cofactors(jacobian);
    normal = directionOr(carrier * normal, normal);
    float size = length(miter);
    if (size > 0.0) {
        miter = size * directionOr(carrier * miter, miter / size);
    }
}

// Free-form deformation (Sederberg, Parry 1986), as in renderer/scene/lattice.cpp, of which this is the pair: keep
// both. Offsets of the control points of all lattices, [z][y][x] each, mm.
#ifdef LATTICE

layout(std430, binding = 7) restrict readonly buffer LatticeOffsets { vec4 latticeOffsets[]; };

const int kMaxLatticePoints = 8;

// Bernstein polynomials and their derivatives; beyond [0, 1] they go on along their tangents.
void latticeBasis(int count, float u, out float value[kMaxLatticePoints], out float slope[kMaxLatticePoints]) {
    float inside = clamp(u, 0.0, 1.0);
    int degree = count - 1;
    for (int i = 0; i < kMaxLatticePoints; ++i) {
        value[i] = i == 0 ? 1.0 : 0.0;
        slope[i] = 0.0;
    }
    for (int n = 1; n <= degree; ++n) {
        if (n == degree) {
            for (int i = 0; i <= degree; ++i) {
                slope[i] = float(degree) * ((i > 0 ? value[i - 1] : 0.0) - (i < degree ? value[i] : 0.0));
            }
        }
        for (int i = n; i >= 0; --i) {
            value[i] = (i < n ? (1.0 - inside) * value[i] : 0.0) + (i > 0 ? inside * value[i - 1] : 0.0);
        }
    }
    for (int i = 0; i <= degree; ++i) {
        value[i] += (u - inside) * slope[i];
    }
}

// size: control points along x, y, z, and the first offset.
vec3 mapThroughLattice(ivec4 size, vec3 low, vec3 inverseExtent, vec3 p, out mat3 jacobian) {
    vec3 u = (p - low) * inverseExtent;
    float x[kMaxLatticePoints], y[kMaxLatticePoints], z[kMaxLatticePoints];
    float dx[kMaxLatticePoints], dy[kMaxLatticePoints], dz[kMaxLatticePoints];
    latticeBasis(size.x, u.x, x, dx);
    latticeBasis(size.y, u.y, y, dy);
    latticeBasis(size.z, u.z, z, dz);
    vec3 offset = vec3(0.0);
    mat3 slopes = mat3(0.0);
    int at = size.w;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            // The sums along x first: they are shared.
            vec3 row = vec3(0.0);
            vec3 rowSlope = vec3(0.0);
            for (int i = 0; i < size.x; ++i) {
                vec3 control = latticeOffsets[at++].xyz;
                row += x[i] * control;
                rowSlope += dx[i] * control;
            }
            offset += y[j] * z[k] * row;
            slopes[0] += y[j] * z[k] * rowSlope;
            slopes[1] += dy[j] * z[k] * row;
            slopes[2] += y[j] * dz[k] * row;
        }
    }
    jacobian = mat3(1.0);
    for (int c = 0; c < 3; ++c) {
        jacobian[c] += inverseExtent[c] * slopes[c];
    }
    return p + offset;
}

#endif

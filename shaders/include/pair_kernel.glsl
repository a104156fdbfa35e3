// The kernel of one (sample, pixel) pair (Chen et al. 2012, eq. 12): the mean over the sample's patch of
// sqrt(P_xo P_xi). The patch has covariance C; along the offset to the pixel it blurs the kernel by q, across
// it lengthens the distance to d' (DESIGN 3.1: a sample is a patch, not a point). The mean over the disc of
// radius sqrt(2 q) about d' is taken at three distances, as an integral over the distance where the disc is wide
// for the profile, at two where it is narrow: d' + q / (4 d') -+ sqrt(q / 2), right to the second order, which
// pair_kernel.inl of renderer/gather, its pair, has from the slope at one.

// sqrt(P_xo P_xi) of the pair in question at distance r; whoever includes this defines it.
vec3 pairProfile(float r);

// Gauss-Legendre on [0, 1]: place and weight.
const vec2 kGauss4[4] = vec2[](vec2(0.06943184, 0.17392742), vec2(0.33000948, 0.32607258),
                               vec2(0.66999052, 0.32607258), vec2(0.93056816, 0.17392742));
const vec2 kGauss6[6] = vec2[](vec2(0.03376524, 0.08566225), vec2(0.16939531, 0.18038079),
                               vec2(0.38069041, 0.23395697), vec2(0.61930959, 0.23395697),
                               vec2(0.83060469, 0.18038079), vec2(0.96623476, 0.08566225));

// The mean over a disc of radius R whose center is at distance d, as an integral over the distance r:
// whole circles up to R - d, then arcs of half angle acos((d^2 + r^2 - R^2) / (2 d r)), which begin and
// end like a root: midpoints in an angle. Returns r and its weight.
vec2 radialTap(int i, int inner, int outer, float d, float R) {
    float gap = abs(R - d);
    if (i < inner) {
        vec2 rule = inner == 4 ? kGauss4[i] : kGauss6[i];
        float r = gap * rule.x;
        return vec2(r, r * gap * 3.14159265 * rule.y);
    }
    float angle = 3.14159265 * (float(i - inner) + 0.5) / float(outer);
    float width = R + d - gap;
    float r = gap + width * (0.5 - 0.5 * cos(angle));
    float halfAngle = acos(clamp((d * d + r * r - R * R) / max(2.0 * d * r, 1e-20), -1.0, 1.0));
    return vec2(r, r * halfAngle * width * sin(angle) * 1.57079633 / float(outer));
}

// offset: from the sample to the pixel, d2 its square; variance, diagonal, offDiagonal (xy, xz, yz): of the
// patch; slope: steepest of -ln P_xi at 0; range: where P of either ends.
vec3 pairKernel(vec3 offset, float d2, float variance, vec3 diagonal, vec3 offDiagonal, float slope, float range) {
    float along = dot(offset * offset, diagonal) + 2.0 * dot(offset.xxy * offset.yzz, offDiagonal);
    float q = d2 > 1e-8 ? min(2.0 * along / d2, 1.3 * variance) : variance;
    float closest2 = max(d2 + variance - q, 0.0);
    float closest = sqrt(closest2);
    float blur = sqrt(q);
    bool narrow = blur < 0.1 * closest && slope * blur < 0.25;
    bool wide = closest < 4.0 * blur && slope * blur > 1.0;
    float discRadius = sqrt(2.0) * blur;
    bool steep = slope * blur > 4.0;
    int inner = closest < discRadius ? (steep ? 6 : 4) : 0;
    int outer = steep ? 10 : 8;
    int count = narrow ? 2 : (wide ? inner + outer : 3);
    vec3 kernel = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < count; ++i) {
        float r2;
        float w = 1.0;
        if (wide) {
            vec2 tap = radialTap(i, inner, outer, closest, discRadius);
            r2 = tap.x * tap.x;
            w = tap.y;
        } else if (count == 3) {
            r2 = closest2 + 0.98 * q + float(i - 1) * 1.7320508 * blur * closest;
        } else {
            r2 = closest2 + q + (float(i) * 2.0 - 1.0) * 1.41421356 * blur * closest;
        }
        float r = sqrt(max(r2, 0.0));
        vec3 value = pairProfile(r);
        kernel += r <= range ? w * value : vec3(0.0);
        total += w;
    }
    return kernel / max(total, 1e-20);
}

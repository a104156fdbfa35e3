layout(binding = 6) uniform sampler2D rangeTable; // Rbar over (log2 T, material)

const float kLogTMax = 12.0; // the table spans log2 T in [0, 12]

// Rbar(T) (Chen et al. 2012, eq. 14): where a splatting level with T pixels in one R_P may begin.
float minimalRadius(float T, int material) {
    vec2 size = vec2(textureSize(rangeTable, 0));
    float x = clamp(log2(max(T, 1.0)) / kLogTMax, 0.0, 1.0);
    return textureLod(rangeTable, vec2((x * (size.x - 1.0) + 0.5) / size.x, (float(material) + 0.5) / size.y), 0.0).r;
}

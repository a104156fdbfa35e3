// A selected node becomes a splat at one level of the splatting buffer, and the rectangle that bounds the
// sphere of its ring in the image.
#include "include/light.glsl"
#include "include/node_splat.glsl"
#include "include/sphere_bounds.glsl"

layout(location = 0) in int nodeIndex;

layout(location = 0) uniform ivec4 levels; // irradiance level, texels in a row of it, splatting level, 0

layout(binding = 26) uniform sampler2D tileRanges; // view depths in tiles of 8 x 8 pixels and up

out SplatPoint {
    flat vec4 rectangle; // clip coordinates: low x, low y, high x, high y; empty: cull
    flat vec4 center;
    flat vec4 flux;
    flat vec3 diagonal;
    flat vec3 offDiagonal;
    flat vec3 ring;
    flat vec4 parent;
    flat vec3 texture_;
} point;

// The rectangle of pixels of level k that bounds a sphere's image: low x, low y, high x, high y.
vec4 boundingPixels(vec3 inView, float radius, int k) {
    vec2 slopesX;
    vec2 slopesY;
    if (frame.eye.w > 0.5) {
        if (-inView.z + radius <= 0.0) {
            return vec4(1.0, 1.0, -1.0, -1.0); // wholly behind the eye
        }
        slopesX = tangentSlopes(inView.x, -inView.z, radius);
        slopesY = tangentSlopes(inView.y, -inView.z, radius);
    } else {
        slopesX = inView.xx + vec2(-radius, radius);
        slopesY = inView.yy + vec2(-radius, radius);
    }
    vec4 ndc = vec4(slopesX.x, slopesY.x, slopesX.y, slopesY.y) * frame.projection.xyxy;
    vec4 pixels = (ndc * 0.5 + 0.5) * frame.frameSize.xyxy / float(1 << k);
    vec2 size = frame.frameSize.zw / float(1 << k);
    // A representative point may lie anywhere in its pixel: one pixel of margin.
    return vec4(clamp(pixels.xy - 1.0, vec2(0.0), size), clamp(pixels.zw + 1.0, vec2(0.0), size));
}

// Whether some pixel within the rectangle (in pixels of level 0) lies between the two view depths.
bool meetsSurface(vec4 pixels, float nearest, float farthest) {
    float extent = max(pixels.z - pixels.x, pixels.w - pixels.y);
    int mip = clamp(int(ceil(log2(max(extent / 16.0, 1.0)))), 0, textureQueryLevels(tileRanges) - 1);
    float tileSize = float(8 << mip);
    ivec2 low = ivec2(pixels.xy / tileSize);
    // Not textureSize(tileRanges, mip): some drivers take one lane's level for all lanes.
    ivec2 high = min(ivec2(pixels.zw / tileSize), (textureSize(tileRanges, 0) >> mip) - 1);
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            vec2 range = texelFetch(tileRanges, ivec2(x, y), mip).xy;
            if (range.x <= farthest && range.y >= nearest) {
                return true;
            }
        }
    }
    return false;
}

void main() {
    int level = levels.x;
    int k = levels.z;
    ivec2 node = ivec2(nodeIndex % levels.y, nodeIndex / levels.y);
    float high;
    Splat splat = makeSplat(node, level, k, high);
    point.center = splat.center;
    point.flux = splat.flux;
    point.diagonal = splat.diagonal;
    point.offDiagonal = splat.offDiagonal;
    point.ring = splat.ring;
    point.parent = splat.parent;
    point.texture_ = splat.texture_;

    point.rectangle = vec4(1.0, 1.0, -1.0, -1.0);
    if (high > 0.0) {
        vec3 inView = (frame.view * vec4(splat.center.xyz, 1.0)).xyz;
        vec4 pixels = boundingPixels(inView, high, k);
        float nearest = -inView.z - high;
        float farthest = -inView.z + high;
        if (splat.parent.w < 1e29) {
            vec3 parentInView = (frame.view * vec4(splat.parent.xyz, 1.0)).xyz;
            float radius = (1.0 + solve.rings.w) * splat.parent.w;
            vec4 inParent = boundingPixels(parentInView, radius, k);
            pixels = vec4(max(pixels.xy, inParent.xy), min(pixels.zw, inParent.zw));
            nearest = max(nearest, -parentInView.z - radius);
            farthest = min(farthest, -parentInView.z + radius);
        }
        if (all(lessThan(pixels.xy, pixels.zw)) && meetsSurface(pixels * float(1 << k), nearest, farthest)) {
            point.rectangle = pixels * float(1 << k) / frame.frameSize.zwzw * 2.0 - 1.0;
        }
    }
    gl_Position = vec4(0.0);
}

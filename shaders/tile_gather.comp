// Splatting turned around for GPUs with many compute units: a work group is a tile of 8 x 8 pixels of one
// splatting level. It walks the tree of nodes from the top down, keeps those that have weight for some pixel
// of the tile, and adds them up, SLICES of them side by side. What its pixels' profiles are, and those of the
// samples at hand, is read once, into shared memory: no pair touches a map. Nothing is counted, sorted or sent
// to the CPU, and there is no list that could overflow: of what is free on the stack of nodes to visit, each level
// of the tree gets its part. Samples, rings and kernel are those of the raster path (include/).
//   SLICES      samples added up side by side
//   BATCH       samples at hand
//   KNOTS       of the finest profile; left out: profiles do not fit into shared memory, and are read per pair
//   HOMOGENEOUS, HIERARCHICAL as in include/node_splat.glsl
#include "include/light.glsl"
#include "include/node_splat.glsl"
#include "include/ordered_float.glsl"
#include "include/pair_kernel.glsl"

const int kPixels = 64;
const int kThreads = kPixels * SLICES;
const int kStack = 1024;
const int kReserve = 64; // a node taken alone leaves at most three more per level on the stack

layout(local_size_x = kPixels, local_size_y = SLICES) in;

layout(location = 0) uniform ivec4 request; // splatting level; level of the roots, their columns and rows
layout(location = 1) uniform ivec2 firstRoot;

layout(binding = 24) uniform sampler2D pixelPositions;
layout(binding = 25) uniform sampler2D pixelSurfaces;
layout(binding = 26) uniform sampler2D tree; // tile_tree.comp
#ifndef HIERARCHICAL
layout(binding = 28) uniform sampler2D fits;
#endif

layout(rgba32f, binding = 0) uniform image2D exitance; // alpha counts the pairs

shared uint stack[kStack];
shared int stackSize;
shared uint found[BATCH + kThreads];
shared int foundCount;
shared Splat splats[BATCH];
shared vec2 splatKnots[BATCH]; // segments, r_s
shared uint tileLow[3];
shared uint tileHigh[3];
shared vec4 totals[kPixels];

int thread;
int pixel;          // of the tile
vec3 boxLow;        // of the tile's surface points, mm
vec3 boxHigh;
int pixelMaterial;  // -1: no scattering surface
vec2 pixelUv;
int splatIndex;     // of the pair at hand

uint packNode(ivec2 node, int level) { return uint(level) << 28 | uint(node.y) << 14 | uint(node.x); }
ivec2 nodeOf(uint code) { return ivec2(code & 0x3fffu, code >> 14 & 0x3fffu); }
int levelOf(uint code) { return int(code >> 28); }

// ln P_xi at a knot of sample j of the batch.
vec3 sampleKnot(int j, int k) {
#ifdef HOMOGENEOUS
    return logProfile(0, vec2(0.5), float(k) * materials[0].profile.x / materials[0].profile.y);
#else
    Splat splat = splats[j];
    int level = levelOf(found[foundCount + j]);
    if (hasOwnProfile(level)) {
        int m = int(splat.texture_.z);
        return logProfile(m, splat.texture_.xy, float(k) * splatKnots[j].y / splatKnots[j].x);
    }
    return texelFetch(nodeProfiles, ivec3(splat.texture_.xy, k), level - 1).rgb;
#endif
}

#ifdef KNOTS
// ln P in 21, 22 and 21 bits: steps of 2.3e-5 at most.
const float kLogLow = -30.0;
const float kLogSpan = 48.0;
const vec3 kSteps = vec3(2097151.0, 4194303.0, 2097151.0);

uvec2 packLog(vec3 logP) {
    uvec3 q = uvec3(clamp((logP - kLogLow) / kLogSpan, 0.0, 1.0) * kSteps + 0.5);
    return uvec2(q.r | q.g << 21, q.g >> 11 | q.b << 11);
}

vec3 unpackLog(uvec2 p) {
    return vec3(p.x & 0x1fffffu, p.x >> 21 | (p.y & 0x7ffu) << 11, p.y >> 11);
}

vec3 betweenKnots(uvec2 a, uvec2 b, float t) {
    return mix(unpackLog(a), unpackLog(b), t) * (kLogSpan / kSteps) + kLogLow;
}

#ifdef HOMOGENEOUS
const int kKept = 1; // all samples have the same
#else
const int kKept = BATCH;
#endif
shared uvec2 sampleProfiles[KNOTS * kKept];

void keepProfiles(int count) {
    for (int i = thread; i < KNOTS * kKept; i += kThreads) {
        int j = i % kKept;
        int k = i / kKept;
        if (j < count && float(k) <= splatKnots[j].x) {
            sampleProfiles[i] = packLog(sampleKnot(j, k));
        }
    }
    barrier();
}

#ifndef HOMOGENEOUS
shared uvec2 pixelProfiles[KNOTS * kPixels];
vec2 pixelKnots; // segments, r_s

vec3 logPixelProfile(float r) {
    float x = min(r / pixelKnots.y, 1.0) * pixelKnots.x;
    float k = min(floor(x), pixelKnots.x - 1.0);
    int at = int(k) * kPixels + pixel;
    return betweenKnots(pixelProfiles[at], pixelProfiles[at + kPixels], x - k);
}
#endif

vec3 logSampleProfile(float r) {
    vec2 knots = splatKnots[splatIndex];
    float x = min(r / knots.y, 1.0) * knots.x;
    float k = min(floor(x), knots.x - 1.0);
    int at = int(k) * kKept + splatIndex % kKept;
    return betweenKnots(sampleProfiles[at], sampleProfiles[at + kKept], x - k);
}
#else
vec3 logPixelProfile(float r) { return logProfile(pixelMaterial, pixelUv, r); }

vec3 logSampleProfile(float r) {
    vec2 knots = splatKnots[splatIndex];
    float x = min(r / knots.y, 1.0) * knots.x;
    float k = min(floor(x), knots.x - 1.0);
    return mix(sampleKnot(splatIndex, int(k)), sampleKnot(splatIndex, int(k) + 1), x - k);
}
#endif

vec3 pairProfile(float r) {
#ifdef HOMOGENEOUS
    return exp(logSampleProfile(r));
#else
    return exp(0.5 * (logSampleProfile(r) + logPixelProfile(r)));
#endif
}

// Whether a sample of this ring has weight for some pixel at a distance in [nearest, farthest].
bool ringMeets(ivec2 node, int level, float depth, float nearest, float farthest) {
    int k = request.x;
#ifdef HIERARCHICAL
    float start = ringRadius(k, depth);
    return start < solve.node.x && farthest > 0.8 * start && nearest < solve.node.x &&
           (!hasNextRing(k, depth) || nearest < 1.2 * ringRadius(k + 1, depth));
#else
    vec4 extent = texelFetch(nodeExtents, node, level);
    vec2 ring = hardRing(k, extent.z, extent.w, depth, int(texelFetch(nodeSurfaces, node, level).z));
    return ring.x < ring.y && farthest >= ring.x && nearest < ring.y;
#endif
}

#ifdef HIERARCHICAL
// Whether rings of level k pass by everything below a node: they lie between those of its least and its
// greatest depth.
bool subtreeIsOutsideRing(vec4 bound, float depth, float nearest, float farthest) {
    int k = request.x;
    if (0.8 * ringRadius(k, max(depth - bound.w, 1e-3)) > farthest + bound.w) {
        return true;
    }
    float outermost = max(depth + bound.w, 1e-3);
    return hasNextRing(k, outermost) && 1.2 * ringRadius(k + 1, outermost) < nearest - bound.w;
}
#endif

// Finds the node a sample of the tile, or puts its children on the stack, or both, or neither.
void visit(uint code) {
    ivec2 node = nodeOf(code);
    int level = levelOf(code);
    vec4 bound = texelFetch(tree, node, level);
    if (bound.w < 0.0) {
        return;
    }
    vec3 outsideBox = max(max(boxLow - bound.xyz, bound.xyz - boxHigh), vec3(0.0));
    vec3 acrossBox = max(abs(bound.xyz - boxLow), abs(bound.xyz - boxHigh));
    float nearest = length(outsideBox);
    float farthest = length(acrossBox);
    if (nearest - bound.w >= solve.node.x) {
        return;
    }
    float depth = -(frame.view * vec4(bound.xyz, 1.0)).z;
    bool descend = true;
    bool take = false;
    if (level < irradianceLevels()) {
#ifdef HIERARCHICAL
        if (subtreeIsOutsideRing(bound, depth, nearest, farthest)) {
            return;
        }
        float ball = texelFetch(balls, node, level).r;
        take = ball < solve.node.x && farthest >= ball;
        descend = ball > 0.0 && (ball > 1e29 || nearest < (1.0 + solve.rings.w) * ball);
#else
        take = texelFetch(fits, node, level).r > 0.5;
        descend = !take;
#endif
    }
    if (take && ringMeets(node, level, max(depth, 1e-3), nearest, farthest)) {
        found[atomicAdd(foundCount, 1)] = code;
    }
    if (descend && level > 0) {
        int at = atomicAdd(stackSize, 4);
        for (int i = 0; i < 4; ++i) {
            stack[at + i] = packNode(node * 2 + ivec2(i & 1, i >> 1), level - 1);
        }
    }
}

// The tile's box, from the surface points of its pixels.
void measureTile(vec4 position) {
    if (thread < 3) {
        tileLow[thread] = 0xffffffffu;
        tileHigh[thread] = 0u;
    }
    barrier();
    if (gl_LocalInvocationID.y == 0u && pixelMaterial >= 0) {
        for (int i = 0; i < 3; ++i) {
            atomicMin(tileLow[i], ordered(position[i]));
            atomicMax(tileHigh[i], ordered(position[i]));
        }
    }
    barrier();
    boxLow = vec3(restored(tileLow[0]), restored(tileLow[1]), restored(tileLow[2]));
    boxHigh = vec3(restored(tileHigh[0]), restored(tileHigh[1]), restored(tileHigh[2]));
}

// The last `count` samples found become those at hand.
void prepareBatch(int count) {
    if (thread < count) {
        uint code = found[foundCount + thread];
        float reach;
        splats[thread] = makeSplat(nodeOf(code), levelOf(code), request.x, reach);
        int m = int(splats[thread].texture_.z);
        splatKnots[thread] = hasOwnProfile(levelOf(code)) ? materials[m].profile.yx : solve.node.yx;
    }
    barrier();
#if defined(KNOTS) && !defined(HOMOGENEOUS)
    keepProfiles(count);
#endif
}

// What the samples at hand add to this thread's pixel.
vec4 gatherBatch(int count, vec3 position, float pixelRange) {
    vec4 sum = vec4(0.0);
    for (int j = int(gl_LocalInvocationID.y); j < count; j += SLICES) {
        vec3 offset = position - splats[j].center.xyz;
        float d2 = dot(offset, offset);
        float d = sqrt(d2);
        float weight = d < splatKnots[j].y ? ringWeight(position, d, splats[j].ring, splats[j].parent) : 0.0;
        if (weight > 0.0) {
            splatIndex = j;
            vec3 kernel = pairKernel(offset, d2, splats[j].center.w, splats[j].diagonal, splats[j].offDiagonal,
                                     splats[j].flux.w, min(pixelRange, splatKnots[j].y));
            sum += vec4(kernel * splats[j].flux.rgb * weight, 1.0);
        }
    }
    return sum;
}

void main() {
    if (light.direction.w == 0.0) {
        return; // a view not in use
    }
    int k = request.x;
    thread = int(gl_LocalInvocationIndex);
    pixel = int(gl_LocalInvocationID.x);
    ivec2 place = ivec2(gl_WorkGroupID.xy) * 8 + ivec2(pixel & 7, pixel >> 3);
    vec4 position = vec4(0.0);
    vec4 surfacePoint = vec4(0.0, 0.0, -1.0, 0.0);
    if (all(lessThan(place, imageSize(exitance)))) {
        position = texelFetch(pixelPositions, place, k);
        surfacePoint = texelFetch(pixelSurfaces, place, k);
    }
    pixelMaterial = position.w > 0.0 ? int(surfacePoint.z) : -1;
    pixelUv = surfacePoint.xy;
    measureTile(position);
    if (tileLow[0] > tileHigh[0]) {
        return; // no scattering surface
    }
    float pixelRange = pixelMaterial >= 0 ? materials[max(pixelMaterial, 0)].profile.x : 0.0;
#if defined(KNOTS) && !defined(HOMOGENEOUS)
    if (pixelMaterial >= 0) {
        pixelKnots = materials[pixelMaterial].profile.yx;
        for (int i = int(gl_LocalInvocationID.y); float(i) <= pixelKnots.x; i += SLICES) {
            float r = float(i) * pixelKnots.y / pixelKnots.x;
            pixelProfiles[i * kPixels + pixel] = packLog(logProfile(pixelMaterial, pixelUv, r));
        }
    }
#endif
    if (thread == 0) {
        stackSize = 0;
        foundCount = 0;
        splatKnots[0] = materials[0].profile.yx;
    }
#if defined(KNOTS) && defined(HOMOGENEOUS)
    barrier();
    keepProfiles(1);
#endif
    if (gl_LocalInvocationID.y == 0u) {
        totals[pixel] = vec4(0.0);
    }

    vec4 sum = vec4(0.0);
    int roots = request.z * request.w;
    int nextRoot = 0;
    bool done = false;
    while (!done) {
        barrier();
        int size = stackSize;
        int pending = foundCount;
        barrier();
        bool exhausted = size == 0 && nextRoot >= roots;
        if (pending >= BATCH || (exhausted && pending > 0)) {
            int count = min(pending, BATCH);
            if (thread == 0) {
                foundCount = pending - count;
            }
            barrier();
            prepareBatch(count);
            if (pixelMaterial >= 0) {
                sum += gatherBatch(count, position.xyz, pixelRange);
            }
        } else if (exhausted) {
            done = true;
        } else {
            // A node taken leaves three more. Were all that is free given to one level, those below it would
            // have to go one by one.
            bool fromStack = size > 0;
            int level = fromStack ? levelOf(stack[size - 1]) : request.y;
            int room = max((kStack - kReserve - size) / (3 * (level + 1)), 1);
            int taken = min(min(fromStack ? size : roots - nextRoot, kThreads), room);
            uint code = 0u;
            if (thread < taken) {
                int root = nextRoot + thread;
                code = fromStack ? stack[size - 1 - thread]
                                   : packNode(firstRoot + ivec2(root % request.z, root / request.z), request.y);
            }
            if (!fromStack) {
                nextRoot += taken;
            }
            barrier();
            if (thread == 0 && fromStack) {
                stackSize = size - taken;
            }
            barrier();
            if (thread < taken) {
                visit(code);
            }
        }
    }
    for (int slice = 0; slice < SLICES; ++slice) {
        if (int(gl_LocalInvocationID.y) == slice) {
            totals[pixel] += sum;
        }
        barrier();
    }
    if (gl_LocalInvocationID.y == 0u && pixelMaterial >= 0) {
        imageStore(exitance, place, imageLoad(exitance, place) + totals[pixel]);
    }
}

// Frusta from which lights see the scattering surface (DESIGN 3.1), one invocation a view, from the
// bounds as they are on the GPU. Directional and spot lights, and points well outside: one square
// frustum fitted to the bounding sphere `target` (a spot's own cone where that is narrower). Points
// near or inside: six cube faces. Every point of the target that the light reaches lies in exactly
// one view in use. Everything of the scene between the light and the target casts shadows.
#include "include/bounds.glsl"

layout(local_size_x = 8) in;

layout(location = 0) uniform ivec3 request; // views, N, 1: the target is the whole scene

struct LightSource {
    vec4 position;  // mm; kind: 0 directional, 1 point, 2 spot
    vec4 direction; // unit, along which light travels; tangent of a spot's cone, 1e30: none or too wide
    vec4 color;     // irradiance or radiant intensity; first view
    vec4 cone;      // cos inner, cos outer; views; 0
};

struct PaddedLightBlock { // uniform blocks begin at multiples of 256 bytes
    LightBlock block;
    vec4 padding[4];
};

layout(std430, binding = 0) restrict readonly buffer Sources { LightSource sources[]; };
layout(std430, binding = 1) restrict readonly buffer SourceOfView { int sourceOfView[]; };
layout(std430, binding = 2) restrict writeonly buffer Views { PaddedLightBlock views[]; };

// A frustum grows by so much, so that the sphere's rim stays inside the outermost texel centers.
const float kMargin = 1.0005;

// Closer than so many radii a point light gets cube faces: the single frustum would be wider than about
// 106 degrees, and its outer texels stretched by more than three.
const float kNearestSingleFrustum = 1.25;

vec3 anyPerpendicular(vec3 axis) {
    return normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
}

// World to view, looking along -z.
mat4 lookAlong(vec3 eye, vec3 axis, vec3 up) {
    vec3 right = normalize(cross(axis, up));
    vec3 above = cross(right, axis);
    return mat4(vec4(right.x, above.x, -axis.x, 0.0), vec4(right.y, above.y, -axis.y, 0.0),
                vec4(right.z, above.z, -axis.z, 0.0), vec4(-dot(right, eye), -dot(above, eye), dot(axis, eye), 1.0));
}

// Reversed depth: 1 at the near plane, 0 at infinity.
mat4 infinitePerspective(float tanHalf, float nearPlane) {
    mat4 m = mat4(0.0);
    m[0][0] = 1.0 / tanHalf;
    m[1][1] = 1.0 / tanHalf;
    m[2][3] = -1.0;
    m[3][2] = nearPlane;
    return m;
}

// Reversed depth over [0, farPlane].
mat4 orthographic(float halfWidth, float farPlane) {
    mat4 m = mat4(1.0);
    m[0][0] = 1.0 / halfWidth;
    m[1][1] = 1.0 / halfWidth;
    m[2][2] = 1.0 / farPlane;
    m[3][2] = 1.0;
    return m;
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= request.x) {
        return;
    }
    LightSource source = sources[sourceOfView[index]];
    int face = index - int(source.color.w);
    int N = request.y;
    bool directional = source.position.w < 0.5;
    vec4 target = request.z != 0 ? bounds.scene : bounds.scattering;
    float radius = max(target.w, 1e-9) * kMargin;

    LightBlock view;
    view.position = directional ? vec4(0.0) : vec4(source.position.xyz, 1.0);
    view.direction = vec4(source.direction.xyz, float(N));
    view.color = vec4(source.color.rgb, source.position.w > 1.5 ? 1.0 : 0.0);
    view.cone = vec4(source.cone.xy, 0.0, 0.0);
    if (directional) {
        // The eye stands before every caster, so that depths are positive and 0 can mean background.
        float reach = distance(bounds.scene.xyz, target.xyz) + bounds.scene.w + target.w;
        float standoff = 1.01 * reach + radius;
        vec3 eye = target.xyz - source.direction.xyz * standoff;
        view.view = lookAlong(eye, source.direction.xyz, anyPerpendicular(source.direction.xyz));
        view.viewProjection = orthographic(radius, 2.0 * standoff) * view.view;
        view.cone.w = 2.0 * radius / float(N);
    } else {
        vec3 offset = target.xyz - source.position.xyz;
        float toCenter = length(offset);
        float nearPlane = 1e-4 * max(target.w, toCenter);
        bool outside = toCenter > kNearestSingleFrustum * radius;
        float sphereTan = outside ? radius / sqrt(toCenter * toCenter - radius * radius) : 1e30;
        float coneTan = source.direction.w * kMargin;
        vec3 axis = source.direction.xyz;
        float tanHalf = coneTan;
        vec3 up = anyPerpendicular(axis);
        if (coneTan >= sphereTan && outside) {
            axis = offset / toCenter;
            tanHalf = sphereTan;
            up = anyPerpendicular(axis);
        } else if (coneTan >= sphereTan) {
            axis = vec3(0.0);
            axis[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
            up = vec3(0.0);
            up[(face / 2 + 1) % 3] = 1.0;
            tanHalf = 1.0;
        }
        if (face > 0 && (outside || coneTan < sphereTan)) {
            view.direction.w = 0.0; // the first view sees all
        }
        view.view = lookAlong(source.position.xyz, axis, up);
        view.viewProjection = infinitePerspective(tanHalf, nearPlane) * view.view;
        view.cone.z = 2.0 * tanHalf / float(N);
    }
    views[index].block = view;
}

// One triangle that covers the viewport; draw 3 vertices of an empty vertex array.

layout(location = 0) out vec2 unitPosition; // (0,0) lower left, (1,1) upper right

void main() {
    unitPosition = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * unitPosition - 1.0, 0.0, 1.0);
}

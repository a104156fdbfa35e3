// Passes on selected nodes only: transform feedback then holds a compact list, in order.
layout(points) in;
layout(points, max_vertices = 1) out;
layout(xfb_buffer = 0, xfb_stride = 4) out;

flat in int selectedNode[];
layout(xfb_offset = 0) flat out int nodeIndex;

void main() {
    if (selectedNode[0] >= 0) {
        nodeIndex = selectedNode[0];
        EmitVertex();
        EndPrimitive();
    }
}

// Depth only: the shadow map of one light view.
#include "include/surface.glsl"

void main() {
    cutOut();
}

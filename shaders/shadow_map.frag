// Depth only: the shadow map of one light view.
void main() {}

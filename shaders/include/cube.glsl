// Direction of a point of a cube map's face; st in [0, 1], faces +x -x +y -y +z -z (OpenGL 4.5, 8.13).
vec3 cubeDirection(int face, vec2 st) {
    vec2 c = st * 2.0 - 1.0;
    vec3 d = face == 0   ? vec3(1.0, -c.y, -c.x)
             : face == 1 ? vec3(-1.0, -c.y, c.x)
             : face == 2 ? vec3(c.x, 1.0, c.y)
             : face == 3 ? vec3(c.x, -1.0, -c.y)
             : face == 4 ? vec3(c.x, -c.y, 1.0)
                         : vec3(-c.x, -c.y, -1.0);
    return normalize(d);
}

// A grid over the unit square, laid on the object's foot plane z = 0; fine enough for the lens.
uniform mat4 camera_from_object;
uniform vec4 footprint;  // x, y of a corner and its extent [m, object frame]
uniform int cells;
out vec3 point_in_camera;
out vec2 place;

void main() {
  int cell = gl_VertexID / 6;
  int corner = gl_VertexID % 6;
  vec2 within = vec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);
  place = (vec2(cell % cells, cell / cells) + within) / float(cells);
  point_in_camera = (camera_from_object * vec4(footprint.xy + footprint.zw * place, 0.0, 1.0)).xyz;
  // Drawn as if nearer by what mapped surfaces are rough, at the same pixel.
  float pulled = max(point_in_camera.z - 0.02, 0.5 * point_in_camera.z);
  gl_Position = clip_from_camera(view_model == 4 ? vec3(point_in_camera.xy, point_in_camera.z - 0.02)
                                                 : point_in_camera * (pulled / point_in_camera.z));
}

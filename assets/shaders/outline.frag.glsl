in vec3 point_in_camera;
uniform vec3 tint;
out vec4 color;

void main() {
  float seen = visibility(gl_FragCoord.xy - 0.5, point_in_camera.z);
  color = vec4(tint * seen, seen);
}

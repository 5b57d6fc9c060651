in float distance_z;
uniform vec3 tint;
out vec4 color;

void main() {
  float seen = visibility(gl_FragCoord.xy - 0.5, distance_z);
  color = vec4(tint * seen, seen);
}

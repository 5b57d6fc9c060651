in vec3 point_in_camera;
in vec2 place;
uniform sampler2D darkness;
out vec4 color;

void main() {
  // Mapped surfaces are rough by centimetres: the shadow lies on one and must not be eaten by it.
  float seen = visibility(gl_FragCoord.xy - 0.5, point_in_camera.z - 0.02);
  color = vec4(0.0, 0.0, 0.0, texture(darkness, place).r * seen);
}

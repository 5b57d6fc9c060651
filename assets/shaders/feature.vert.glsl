// One ellipse an instance, as a rectangle that holds it.
layout(location = 0) in vec2 centre;    // target px
layout(location = 1) in vec4 axes;      // target px: semi-axes a and b as vectors
layout(location = 2) in vec4 color;
out vec2 offset;                        // target px from the centre
flat out vec4 axes_;
flat out vec4 color_;

void main() {
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  vec2 reach = sqrt(axes.xy * axes.xy + axes.zw * axes.zw) + 2.0;
  offset = corner * reach;
  axes_ = axes;
  color_ = color;
  gl_Position = clip_from_target(centre + offset, 0.0, 1.0);
}

// A glazed surface under a warm key light, a cool fill light and a bright ceiling, in linear light.
// The real lights are not known: these hang above the plane the object stands on.
in vec3 point_in_camera;
in vec3 normal_in_camera;
in vec3 albedo;
uniform vec3 up_in_camera;
uniform vec3 key_in_camera;   // towards the lights, unit
uniform vec3 fill_in_camera;
uniform vec3 towards_viewer;  // zero: perspective, from the camera's centre
uniform float gloss;
out vec4 color;

float lobe(vec3 n, vec3 light, vec3 viewer, float sharpness) {
  return pow(max(dot(n, normalize(light + viewer)), 0.0), sharpness);
}

void main() {
  vec3 viewer = dot(towards_viewer, towards_viewer) > 0.0 ? towards_viewer : -normalize(point_in_camera);
  vec3 n = normalize(normal_in_camera);
  if (dot(n, viewer) < 0.0) n = -n;

  float upwards = 0.5 + 0.5 * dot(n, up_in_camera);
  vec3 ambient = mix(vec3(0.20, 0.17, 0.15), vec3(0.44, 0.46, 0.50), upwards);
  vec3 diffuse = vec3(0.92, 0.86, 0.78) * max(dot(n, key_in_camera), 0.0) +
                 vec3(0.14, 0.17, 0.22) * max(dot(n, fill_in_camera), 0.0);

  // The glaze mirrors a dim room with a soft bright ceiling (Schlick's Fresnel, 4 % head on).
  float facing = clamp(dot(n, viewer), 0.0, 1.0);
  float fresnel = 0.04 + 0.96 * pow(1.0 - facing, 5.0);
  vec3 mirrored = reflect(-viewer, n);
  float ceiling = smoothstep(0.1, 0.9, dot(mirrored, up_in_camera));
  vec3 glaze = fresnel * mix(vec3(0.16), vec3(0.9, 0.92, 0.95), ceiling) +
               0.45 * lobe(n, key_in_camera, viewer, 90.0) * vec3(1.0, 0.96, 0.9) +
               0.06 * lobe(n, key_in_camera, viewer, 12.0) +
               0.10 * lobe(n, fill_in_camera, viewer, 40.0);

  vec3 linear = albedo * (ambient + diffuse) + gloss * glaze;
  linear = linear / (1.0 + max(linear - 0.8, 0.0));  // a shoulder instead of clipped highlights
  vec3 srgb = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  float seen = visibility(gl_FragCoord.xy - 0.5, point_in_camera.z);
  color = vec4(srgb * seen, seen);
}

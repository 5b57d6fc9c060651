// A glazed surface under a warm key light, a cool fill light and a bright ceiling, in linear light.
// The real lights are not known: these hang above the plane the object stands on. All but the sharp
// highlight is computed here: a software rasteriser pays for every fragment of small triangles.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;  // sRGB
uniform mat4 camera_from_object;     // a similarity
uniform vec3 up_in_camera;
uniform vec3 key_in_camera;          // towards the lights, unit
uniform vec3 fill_in_camera;
out float distance_z;                // m along z
out vec3 shade;                      // linear
out vec3 normal_in_camera;
out vec3 towards_half;               // between key light and viewer

float lobe(vec3 n, vec3 light, vec3 viewer, float sharpness) {
  return pow(max(dot(n, normalize(light + viewer)), 0.0), sharpness);
}

void main() {
  vec3 point = (camera_from_object * vec4(position, 1.0)).xyz;
  gl_Position = clip_from_camera(point);
  distance_z = point.z;

  vec3 viewer = view_model == 4 ? vec3(0.0, 0.0, -1.0) : -normalize(point);
  vec3 n = normalize(mat3(camera_from_object) * normal);
  normal_in_camera = n;
  towards_half = normalize(key_in_camera + viewer);

  float upwards = 0.5 + 0.5 * dot(n, up_in_camera);
  vec3 ambient = mix(vec3(0.10, 0.085, 0.075), vec3(0.30, 0.315, 0.34), upwards);
  vec3 diffuse = vec3(0.86, 0.80, 0.72) * max(dot(n, key_in_camera), 0.0) +
                 vec3(0.10, 0.12, 0.16) * max(dot(n, fill_in_camera), 0.0);

  // The glaze mirrors a dim room with a soft bright ceiling (as Fresnel has it, softened).
  float fresnel = 0.04 + 0.36 * pow(1.0 - clamp(dot(n, viewer), 0.0, 1.0), 5.0);
  float ceiling = smoothstep(0.1, 0.9, dot(reflect(-viewer, n), up_in_camera));
  vec3 glaze = fresnel * mix(vec3(0.16), vec3(0.9, 0.92, 0.95), ceiling) +
               0.06 * lobe(n, key_in_camera, viewer, 12.0) + 0.10 * lobe(n, fill_in_camera, viewer, 40.0);
  // Near the plane it stands on, what faces down sees little light.
  float open = 1.0 - 0.85 * (1.0 - upwards * upwards) * exp(-position.z / 0.012);
  shade = pow(color.rgb, vec3(2.2)) * (ambient + diffuse) + glaze;
  shade *= open;
}

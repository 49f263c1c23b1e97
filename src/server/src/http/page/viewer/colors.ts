// Colors of the views. Those of charts and of distortion match the pictures that the service draws.

/** Stops of the scale of distortion, in Oklab: pale where there is none. */
const HEAT = [
  [0.95, 0.002, 0.012],
  [0.8, 0.055, 0.065],
  [0.64, 0.14, 0.075],
  [0.46, 0.15, 0],
  [0.28, 0.09, -0.06],
] as const;

/** Stops of the scale of texel density: too few, as most, too many. */
const DENSITY = [
  [0.5, 0.14, 0.06],
  [0.72, 0.08, 0.06],
  [0.95, 0, 0.005],
  [0.7, -0.04, -0.08],
  [0.45, -0.04, -0.14],
] as const;

/** Returns a scale for a style sheet. */
export function gradient(measure: string): string {
  const stops = stopsOf(measure).map(([l, a, b]) => `oklab(${l} ${a} ${b})`);
  return `linear-gradient(to right in oklab, ${stops.join(", ")})`;
}

function stopsOf(measure: string) {
  return measure === "density" ? DENSITY : HEAT;
}

const array = (stops: readonly (readonly number[])[]) => stops.map((stop) => `vec3(${stop.map((x) => x.toFixed(3)).join(", ")})`).join(", ");

/** The scales for shaders: `oklab`, `heatColor`, `densityColor`, `chartColor`. */
export const COLORS = /* glsl */ `
vec3 oklab(vec3 c) {
  float l = c.x + 0.3963377774 * c.y + 0.2158037573 * c.z;
  float m = c.x - 0.1055613458 * c.y - 0.0638541728 * c.z;
  float s = c.x - 0.0894841775 * c.y - 1.2914855480 * c.z;
  vec3 cubes = vec3(l * l * l, m * m * m, s * s * s);
  vec3 linear = clamp(vec3(
    dot(cubes, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
    dot(cubes, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
    dot(cubes, vec3(-0.0041960863, -0.7034186147, 1.7076147010))), 0.0, 1.0);
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}
const vec3 HEAT[5] = vec3[5](${array(HEAT)});
const vec3 DENSITY[5] = vec3[5](${array(DENSITY)});
vec3 heatColor(float t) {
  float at = clamp(t, 0.0, 1.0) * 4.0;
  int k = min(int(at), 3);
  return oklab(mix(HEAT[k], HEAT[k + 1], at - float(k)));
}
vec3 densityColor(float t) {
  float at = clamp(t, 0.0, 1.0) * 4.0;
  int k = min(int(at), 3);
  return oklab(mix(DENSITY[k], DENSITY[k + 1], at - float(k)));
}
vec3 chartColor(uint id) {
  float turn = fract(0.58 + 0.6180339887 * float(id)) * 6.2831853;
  float lightness = id % 3u == 0u ? 0.84 : id % 3u == 1u ? 0.78 : 0.88;
  return oklab(vec3(lightness, 0.075 * cos(turn), 0.075 * sin(turn)));
}
`;

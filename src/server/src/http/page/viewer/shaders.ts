// The shaders of both views. Faces share no corners, so the index of a vertex determines its face. The data of faces
// are in two textures, one texel per face: values, and ids with marks.

import { COLORS } from "./colors";

/** Texels per row of the textures of faces: the minimum that WebGL 2 guarantees. */
export const ROW = 2048;

const FACES = /* glsl */ `
precision highp float;
precision highp int;
precision highp usampler2D;
uniform highp usampler2D uIds;
uniform highp sampler2D uValues;
uniform int uAtlas;
uniform float uAspect;
ivec2 texelOf(uint face) { return ivec2(int(face) % ${ROW}, int(face) / ${ROW}); }
`;

/** Places of the islands of the shown atlas, two texels per chart: a, b, s, t of a similarity, and its marks: 1
 * selected, 2 locked, 4 wrong. */
const PLACED = /* glsl */ `
uniform vec2 uOnly;
bool isLeftOut(uint chart, uint group) {
  return 0.0 <= uOnly.x && (float(chart) != uOnly.x || float(group) != uOnly.y);
}
uniform int uArranging;
uniform highp sampler2D uPlaced;
vec4 placedTexel(uint chart, int part) {
  int k = 2 * int(chart) + part;
  return texelFetch(uPlaced, ivec2(k % ${ROW}, k / ${ROW}), 0);
}
int placedMarks(uint chart, uint group) {
  return uArranging == 1 && int(group) == uAtlas ? int(placedTexel(chart, 1).x) : 0;
}
// What is selected lies above the rest.
float placedDepth(uint chart, uint group) {
  return (placedMarks(chart, group) & 1) != 0 ? -0.5 : 0.0;
}
vec2 placedAt(vec2 inPlane, uint chart, uint group) {
  if (uArranging == 0 || int(group) != uAtlas) return inPlane;
  vec4 m = placedTexel(chart, 0);
  vec2 p = vec2(inPlane.x * uAspect, inPlane.y);
  return vec2((m.x * p.x - m.y * p.y + m.z) / uAspect, m.y * p.x + m.x * p.y + m.w);
}
`;

export const SURFACE_VERTEX = /* glsl */ `${FACES}${PLACED}
in vec2 faceUv;
flat out uint vFace;
out vec2 vUv;
out vec3 vNormal;
out vec3 vCorner;
void main() {
  vFace = uint(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  vCorner = vec3(corner == 0, corner == 1, corner == 2);
  uvec4 ids = texelFetch(uIds, texelOf(vFace), 0);
  uint group = ids.z & 0xffffu;
  vUv = placedAt(faceUv, ids.y, group);
  vNormal = normalMatrix * normal;
#ifdef PLANE
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vUv.x * uAspect, vUv.y, 0.0, 1.0);
  gl_Position.z = placedDepth(ids.y, group);
  if (int(group) != uAtlas || isnan(faceUv.x)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
#else
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
#endif
  if (isLeftOut(ids.y, group)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
}`;

export const SURFACE_FRAGMENT = /* glsl */ `${FACES}${PLACED}${COLORS}
uniform int uShade;
uniform int uMeasure;
uniform vec2 uRange;
uniform vec2 uChecker;
uniform sampler2D uImage;
uniform sampler2D uTexels;
uniform float uPages;
uniform int uLevel;
uniform vec4 uHover;
uniform vec4 uSelected;
uniform int uWire;
uniform int uProblems;
uniform float uPixelRatio;
flat in uint vFace;
in vec2 vUv;
in vec3 vNormal;
in vec3 vCorner;
layout(location = 0) out vec4 color;

const vec3 CLAY = vec3(0.86, 0.87, 0.88);
const vec3 PICKED = vec3(1.0, 0.58, 0.13);

vec3 checker() {
  vec2 cell = floor(vUv * uChecker);
  vec2 block = floor(cell / 8.0);
  float odd = mod(cell.x + cell.y, 2.0);
  float blockOdd = mod(block.x + block.y, 2.0);
  vec3 light = mix(vec3(0.93), vec3(0.86, 0.90, 0.95), blockOdd);
  vec3 dark = mix(vec3(0.50, 0.52, 0.55), vec3(0.36, 0.44, 0.56), blockOdd);
  return mix(light, dark, odd);
}

// Like stretchOf of the analysis.
float stretchOf(float value) {
  if (uMeasure != 0) return value - 1.0;
  float q = max(value / 4.0, 1.0);
  return sqrt(q + sqrt(q * q - 1.0)) - 1.0;
}

vec3 heat() {
  float value = texelFetch(uValues, texelOf(vFace), 0)[uMeasure];
  if (isnan(value)) return vec3(0.69);
  if (uMeasure == 3) return densityColor(log(value / uRange.x) / log(uRange.y / uRange.x));
  return heatColor((stretchOf(value) - uRange.x) / (uRange.y - uRange.x));
}

vec3 fill(uint chart, uint group) {
  if (uShade == 3) return heat();
  if (isnan(vUv.x)) return CLAY;
  if (uShade == 1) return chartColor(chart);
  if (uShade == 2) return checker();
  if (uShade == 4) return texture(uImage, vUv).rgb;
  if (uShade == 6 && int(group) == uAtlas) return textureLod(uTexels, vec2(vUv.x / uPages, vUv.y), float(uLevel)).rgb;
  return CLAY;
}

/** Returns 0 on the edges of the face, and 1 farther inside than this number of pixels, softened over 0.8. */
float inner(float pixels) {
  vec3 width = fwidth(vCorner);
  vec3 inside = smoothstep(width * pixels, width * (pixels + 0.8), vCorner);
  return min(inside.x, min(inside.y, inside.z));
}

void main() {
  uvec4 ids = texelFetch(uIds, texelOf(vFace), 0);
  uint marks = ids.z >> 16;
  float face = float(ids.x), chart = float(ids.y), group = float(ids.z & 0xffffu);
  bool isHovered = uHover.x == face || (uHover.y == chart && uHover.z == group);
  bool isFace = uSelected.x == face;
  bool isPicked = isFace || (uSelected.y == chart && uSelected.z == group);
  int placed = placedMarks(ids.y, ids.z & 0xffffu);
  isPicked = isPicked || (placed & 1) != 0;
  bool isWrong = uProblems == 1 && uArranging == 0 && (marks & 3u) != 0u;
#ifdef OVERLAY
  if (!isHovered && !isPicked && !isWrong && placed == 0) discard;
#endif
  vec3 base = fill(ids.y, ids.z & 0xffffu);
  float strength = 1.0;
  if (isWrong) base = (marks & 1u) != 0u ? vec3(0.87, 0.15, 0.17) : vec3(1.0, 0.84, 0.04);
  if ((placed & 4) != 0) base = mix(base, vec3(0.87, 0.15, 0.17), 0.7);
  else if (uArranging == 1) base = mix(base, PICKED, isPicked ? 0.35 : isHovered ? 0.2 : 0.0);
  else {
    // What is selected has an outline: that of a chart or a seam is drawn with the borders. What is pointed at is tinted.
    float edge = isFace ? 1.0 - inner(1.5) : 0.0;
    strength = max(edge, isHovered ? 0.3 : 0.0);
#ifdef OVERLAY
    if (!isWrong) base = PICKED;
#else
    base = mix(base, PICKED, strength);
#endif
  }
  if ((placed & 2) != 0) {
    // Hatched: stripes that stay where they are on the screen.
    float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / uPixelRatio, 9.0);
    base *= 1.0 - 0.34 * smoothstep(0.0, 1.0, stripe) * smoothstep(3.2, 2.2, stripe);
  }
  float light = 1.0;
#ifndef PLANE
  vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
  light = 0.52 + 0.42 * max(dot(n, normalize(vec3(0.25, 0.4, 0.9))), 0.0) + 0.12 * max(n.y, 0.0);
  // What is pointed at is seen in the shade, too.
  if (isHovered) light = mix(light, 1.0, 0.7);
#endif
  if (uWire == 1) {
    vec3 width = fwidth(vCorner);
    // Lines fade where faces are too small for them.
    float dark = 0.42 * clamp(1.0 - 2.2 * max(width.x, max(width.y, width.z)), 0.0, 1.0);
    base *= 1.0 - dark * (1.0 - inner(0.4));
  }
#ifdef OVERLAY
  color = vec4(base * light, isWrong ? 0.9 : placed != 0 ? 0.75 : strength);
#else
  color = vec4(base * light, 1.0);
#endif
}`;

/** Fragment shader that writes the number of the drawn face, from 1. */
export const PICK_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
flat in uint vFace;
layout(location = 0) out vec4 color;
void main() {
  uint id = vFace + 1u;
  color = vec4(float(id & 255u), float((id >> 8) & 255u), float((id >> 16) & 255u), float(id >> 24)) / 255.0;
}`;

export const BORDER_VERTEX = /* glsl */ `
precision highp float;
precision highp int;
uniform int uAtlas;
uniform float uAspect;
${PLACED}
uniform vec2 uViewport;
uniform float uPixelRatio;
uniform vec4 uHover;
uniform vec4 uSelected;
uniform float uThick;
uniform int uSeams;
in vec3 from;
in vec3 to;
in vec4 planeEnds;
in uvec4 facts;
flat out uint vId;
flat out vec4 vColor;

// Seams lie this share of their distance before the surface, which hides those behind it at any distance.
vec4 placed(vec3 inScene, vec2 inPlane, float before) {
#ifdef PLANE
  return projectionMatrix * modelViewMatrix * vec4(inPlane.x * uAspect, inPlane.y, 0.0, 1.0);
#else
  vec4 seen = modelViewMatrix * vec4(inScene, 1.0);
  return projectionMatrix * vec4(seen.xyz * (1.0 - before), 1.0);
#endif
}

void main() {
  uint ofGroup = facts.y & 0xffffu;
  int mark = placedMarks(facts.x, ofGroup);
  float chart = float(facts.x), group = float(facts.y & 0xffffu), seam = float(facts.z);
  uint marks = facts.y >> 16;
  bool isHovered = uHover.w == seam || (uHover.y == chart && uHover.z == group);
  bool isPicked = uSelected.w == seam || (uSelected.y == chart && uSelected.z == group);
  isPicked = isPicked || (mark & 1) != 0;
  // Both sides of a seam lie at one place: what is pointed at covers the other.
  float before = isHovered || isPicked ? 0.003 : 0.0015;
  vec4 a = placed(from, placedAt(planeEnds.xy, facts.x, ofGroup), before);
  vec4 b = placed(to, placedAt(planeEnds.zw, facts.x, ofGroup), before);
  bool isNear = uArranging == 1 ? (mark & 4) != 0 : (marks & 4u) != 0u;
  float width = isNear ? 3.0 : (marks & 8u) != 0u ? 2.2 : 1.4;
  if (isHovered || isPicked) width += 1.6;
#ifndef PICK
  else if (uSeams == 0) width = 0.0;
#endif
  width = (width + uThick) * uPixelRatio;
  vColor = (isPicked || isHovered) && !(isNear && uArranging == 1) ? vec4(0.95, 0.45, 0.0, 1.0) : isNear ? vec4(0.87, 0.15, 0.17, 1.0) : vec4(0.07, 0.33, 0.75, 1.0);
  vId = facts.w + 1u;
  vec2 along = (b.xy / b.w - a.xy / a.w) * uViewport;
  along = length(along) < 1e-4 ? vec2(1.0, 0.0) : normalize(along);
  vec2 side = vec2(-along.y, along.x) * position.y + along * (position.x * 2.0 - 1.0) * 0.5;
  gl_Position = position.x < 0.5 ? a : b;
  gl_Position.xy += side * width / uViewport * gl_Position.w;
#ifdef PLANE
  gl_Position.z = placedDepth(facts.x, ofGroup) - 0.01;
  if (int(group) != uAtlas) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
#endif
  if (isLeftOut(facts.x, ofGroup)) gl_Position = vec4(2.0, 2.0, 2.0, 0.0);
}`;

export const BORDER_FRAGMENT = /* glsl */ `
precision highp float;
flat in uint vId;
flat in vec4 vColor;
layout(location = 0) out vec4 color;
void main() {
#ifdef PICK
  color = vec4(float(vId & 255u), float((vId >> 8) & 255u), float((vId >> 16) & 255u), float(vId >> 24)) / 255.0;
#else
  color = vColor;
#endif
}`;

// The texture as a baker fills it.

export const GUTTER_FACE_VERTEX = /* glsl */ `${FACES}
uniform float uPages;
in vec2 faceUv;
flat out uint vChart;
void main() {
  uvec4 ids = texelFetch(uIds, texelOf(uint(gl_VertexID / 3)), 0);
  vChart = ids.y;
  gl_Position = vec4(2.0 * faceUv.x / uPages - 1.0, 2.0 * faceUv.y - 1.0, -1.0, 1.0);
  if (int(ids.z & 0xffffu) != uAtlas || isnan(faceUv.x)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

export const GUTTER_FACE_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${COLORS}
flat in uint vChart;
layout(location = 0) out vec4 color;
void main() { color = vec4(chartColor(vChart), 1.0); }`;

/** Vertex shader of everything that is not farther from a border than the radius, in texels. */
export const GUTTER_VERTEX = /* glsl */ `
precision highp float;
precision highp int;
uniform int uAtlas;
uniform float uPages;
uniform float uRadius;
uniform vec2 uSize;
in vec4 planeEnds;
in uvec4 facts;
flat out uint vChart;
flat out vec4 vEnds;
out vec2 vAt;
void main() {
  vec2 scale = vec2(uSize.x / uPages, uSize.y);
  vec2 a = planeEnds.xy * scale, b = planeEnds.zw * scale;
  vec2 along = distance(a, b) < 1e-6 ? vec2(1.0, 0.0) : normalize(b - a);
  float end = 2.0 * position.x - 1.0;
  vAt = (end < 0.0 ? a : b) + uRadius * (end * along + position.y * vec2(-along.y, along.x));
  vEnds = vec4(a, b);
  vChart = facts.x;
  gl_Position = vec4(2.0 * vAt / uSize - 1.0, 0.0, 1.0);
  if (int(facts.y & 0xffffu) != uAtlas || uRadius <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

export const GUTTER_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${COLORS}
uniform float uRadius;
flat in uint vChart;
flat in vec4 vEnds;
in vec2 vAt;
layout(location = 0) out vec4 color;
void main() {
  vec2 line = vEnds.zw - vEnds.xy;
  float t = clamp(dot(vAt - vEnds.xy, line) / max(dot(line, line), 1e-12), 0.0, 1.0);
  float away = distance(vAt, vEnds.xy + t * line) / uRadius;
  if (1.0 < away) discard;
  color = vec4(chartColor(vChart), 1.0);
  // The nearest chart covers the others.
  gl_FragDepth = max(away, 1e-4);
}`;

export const TEXELS_VERTEX = /* glsl */ `
out vec2 vAt;
void main() {
  vAt = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const TEXELS_FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D uTexels;
uniform int uLevel;
in vec2 vAt;
layout(location = 0) out vec4 color;
void main() {
  ivec2 size = textureSize(uTexels, uLevel);
  color = vec4(texelFetch(uTexels, clamp(ivec2(vAt * vec2(size)), ivec2(0), size - 1), uLevel).rgb, 1.0);
}`;

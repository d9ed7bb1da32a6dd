// The programs of the graphics processor. Balls and rods are drawn exactly: a rectangle that covers one, in which each
// pixel solves for where its ray meets the surface. The corners fetch their ball from a texture ("vertex pulling"),
// because instances are much slower in software.

const head = `#version 300 es
precision highp float;
precision highp sampler2D;
`;
const depthHead = (conservative) => `#version 300 es
${conservative ? "#extension GL_EXT_conservative_depth : require\nlayout(depth_greater) out highp float gl_FragDepth;" : ""}
precision highp float;
`;

/** What all vertex programs share. */
const corner = `
uniform mat4 view, projection;
uniform vec4 clip;             // m; points with dot(clip.xyz, p) > clip.w are not shown
uniform int columns;           // of textures with numbers
uniform vec2 range;
uniform sampler2D colours, numbers, values;
const vec2 corners[4] = vec2[4](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1));
vec4 fetch(sampler2D from, int k) { return texelFetch(from, ivec2(k % columns, k / columns), 0); }
bool isHidden(vec3 p) { return dot(clip.xyz, p) > clip.w; }
const vec4 nowhere = vec4(2, 2, 2, 1);
const vec3 water = vec3(0.15, 0.45, 0.85);
vec3 colourOf(float value) {
    float share = range.y > range.x ? (value - range.x) / (range.y - range.x) : 0.5;
    return texture(colours, vec2((clamp(share, 0., 1.) * 255. + 0.5) / 256., 0.5)).rgb;
}
`;

/** The light comes from the eye: what faces it has its full colour. */
const light = `
vec3 lit(vec3 colour, vec3 normal, vec3 ray) { return colour * (0.3 + 0.7 * max(0., -dot(normal, ray))); }
float depthOf(mat4 projection, vec3 at) { vec4 s = projection * vec4(at, 1); return 0.5 * s.z / s.w + 0.5; }
`;

export const balls = {
    vertex: head + corner + `
uniform bool isWater;          // in one colour; else by value
out vec3 colour, towards;
flat out vec4 ball;
void main() {
    int k = gl_VertexID / 4;
    vec4 grain = fetch(numbers, k);
    if (grain.w <= 0. || isHidden(grain.xyz)) { gl_Position = nowhere; return; }
    vec3 centre = (view * vec4(grain.xyz, 1)).xyz;
    float r = grain.w, far = length(centre);
    vec3 ahead = centre / far, side = normalize(cross(ahead, abs(ahead.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    // The cone of rays that touch the ball, where it meets the plane before it.
    float half_ = r * far / sqrt(max(far * far - r * r, 1e-12 * far * far));
    vec2 c = corners[gl_VertexID - 4 * k];
    towards = (centre + half_ * (c.x * side + c.y * cross(side, ahead))) * max((far - 1.001 * r) / far, 1e-4);
    ball = vec4(centre, r);
    colour = isWater ? water : colourOf(fetch(values, k).r);
    gl_Position = projection * vec4(towards, 1);
}`,
    fragment: (conservative) => depthHead(conservative) + light + `
uniform mat4 projection;
in vec3 colour, towards;
flat in vec4 ball;
out vec4 pixel;
void main() {
    vec3 ray = normalize(towards);
    float along = dot(ray, ball.xyz), q = along * along - dot(ball.xyz, ball.xyz) + ball.w * ball.w;
    if (q < 0.) discard;
    vec3 at = ray * (along - sqrt(q));
    gl_FragDepth = depthOf(projection, at);
    pixel = vec4(lit(colour, (at - ball.xyz) / ball.w, ray), 1);
}`,
};

export const rods = {
    vertex: head + corner + `
uniform bool hasColours;       // by the number at the second end; else as water
out vec3 colour, towards;
flat out vec4 begin;
flat out vec4 axis;            // unit vector and length
void main() {
    int k = gl_VertexID / 4;
    vec4 first = fetch(numbers, 2 * k), second = fetch(numbers, 2 * k + 1);
    if (first.w <= 0. || isHidden(first.xyz)) { gl_Position = nowhere; return; }
    vec3 a = (view * vec4(first.xyz, 1)).xyz, b = (view * vec4(second.xyz, 1)).xyz, middle = 0.5 * (a + b);
    float r = first.w, len = max(length(b - a), 1e-6 * r), far = length(middle);
    axis = vec4((b - a) / len, len);
    vec3 ahead = middle / far, across = cross(axis.xyz, ahead);
    float turned = length(across);
    across = turned > 1e-4 ? across / turned : normalize(cross(ahead, abs(ahead.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    vec3 along = cross(ahead, across);
    float halfLength = 0.5 * len * abs(dot(axis.xyz, along)) + r, before = 0.5 * len * abs(dot(axis.xyz, ahead)) + r;
    vec2 c = corners[gl_VertexID - 4 * k];
    float wider = 1.15 * far / max(far - before, 0.2 * far);
    towards = (middle + wider * (r * c.x * across + halfLength * c.y * along)) * max((far - before) / far, 0.2);
    begin = vec4(a, r);
    colour = hasColours ? colourOf(second.w) : water;
    gl_Position = projection * vec4(towards, 1);
}`,
    fragment: (conservative) => depthHead(conservative) + light + `
uniform mat4 projection;
in vec3 colour, towards;
flat in vec4 begin, axis;
out vec4 pixel;
void main() {
    vec3 ray = normalize(towards), x = axis.xyz, from = -begin.xyz;
    vec3 d = ray - dot(ray, x) * x, o = from - dot(from, x) * x;
    float a = max(dot(d, d), 1e-12), b = dot(d, o), c = dot(o, o) - begin.w * begin.w, q = b * b - a * c;
    if (q < 0.) discard;
    vec3 at = ray * ((-b - sqrt(q)) / a), normal;
    float place = dot(at - begin.xyz, x);
    if (place < 0. || place > axis.w) {    // perhaps it is the flat end that is met
        float end = place < 0. ? 0. : axis.w, slope = dot(ray, x);
        if (abs(slope) < 1e-9) discard;
        float t = (dot(begin.xyz, x) + end) / slope;
        at = t * ray;
        vec3 off = at - begin.xyz - end * x;
        if (t < 0. || dot(off, off) > begin.w * begin.w) discard;
        normal = place < 0. ? -x : x;
    } else {
        normal = (at - begin.xyz - place * x) / begin.w;
    }
    gl_FragDepth = depthOf(projection, at);
    pixel = vec4(lit(colour, normal, ray), 1);
}`,
};

/** Triangles: walls in one colour that lets through, or by a value, and surfaces of grains in the colour of their grain. */
export const triangles = {
    vertex: head + corner + `
uniform bool areGrains, hasValues;
layout(location = 0) in vec4 place;    // m, and the row of the grain, or the value of a wall
out vec3 colour, at;
void main() {
    at = (view * vec4(place.xyz, 1)).xyz;
    bool hidden = areGrains && isHidden(fetch(numbers, int(place.w)).xyz);
    colour = areGrains ? colourOf(fetch(values, int(place.w)).r) : hasValues ? colourOf(place.w) : vec3(0.5, 0.56, 0.66);
    gl_Position = hidden ? nowhere : projection * vec4(at, 1);
}`,
    fragment: () => head + light + `
uniform float opacity;
uniform float middle;          // m, before the eye: walls nearer than what is looked at would veil it
in vec3 colour, at;
out vec4 pixel;
void main() {
    vec3 ray = normalize(at), normal = normalize(cross(dFdx(at), dFdy(at)));
    pixel = vec4(lit(colour, dot(normal, ray) > 0. ? -normal : normal, ray), opacity < 1. && -at.z < middle ? 0.2 * opacity : opacity);
}`,
};

"use strict";
// Two meshes side by side under one camera, by WebGL 2.

const VERTEX_SHADER = `#version 300 es
in vec3 position;
in vec4 color;
uniform mat3 turn;
uniform vec3 target;
uniform vec2 zoom;
out vec3 eye;
out vec3 weights;
out vec3 hue;
void main() {
  int k = gl_VertexID % 3;
  weights = vec3(k == 0, k == 1, k == 2);
  hue = color.rgb;
  eye = turn * (position - target);
  gl_Position = vec4(eye.xy * zoom, -eye.z / 4., 1);
}`;

// An edge is a dark line of a pixel; where triangles are smaller than a few pixels, lines fade. In fans
// around the triangles' first corners only the edges opposite to these are drawn.
const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in vec3 eye;
in vec3 weights;
in vec3 hue;
uniform float lines;
uniform float mark;
uniform float front;
uniform bool fans;
out vec4 pixel;
void main() {
  if (eye.z > front) discard;
  vec3 normal = normalize(cross(dFdx(eye), dFdy(eye)));
  vec3 width = fwidth(weights), pixels = weights / width;
  float near = fans ? pixels.x : min(pixels.x, min(pixels.y, pixels.z));
  float small = smoothstep(.12, .4, max(width.x, max(width.y, width.z)));
  float line = lines * (1. - small) * (1. - smoothstep(.5, 1.5, near));
  vec3 lit = mix(hue, vec3(1, 0, .55), mark) * (.45 + .55 * abs(normal.z));
  pixel = vec4(mix(lit, vec3(.1), .75 * line), 1);
}`;

class View {
  /// `meshes`: input, output, and fans that may be shown instead of it, of {corners: Float32Array (9
  /// numbers a triangle)}. Throws without WebGL 2.
  constructor(canvas, meshes) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!this.gl) throw new Error("no WebGL 2");
    this.program = this.link();
    this.uniforms = {};
    for (const name of ["turn", "target", "zoom", "lines", "mark", "front", "fans"])
      this.uniforms[name] = this.gl.getUniformLocation(this.program, name);
    this.meshes = meshes.map(mesh => this.upload(mesh.corners));
    this.lines = 1;
    this.right = 1; // the mesh beside the input
    this.radius = Math.sqrt(meshes[0].corners.reduce( // of all about the box's center
      (most, x, i, p) => i % 3 ? most : Math.max(most, x * x + p[i + 1] ** 2 + p[i + 2] ** 2), 0));
    this.whole();
    this.listen();
  }

  link() {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX_SHADER],
                                  [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "position");
    gl.bindAttribLocation(program, 1, "color");
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  upload(corners) {
    const gl = this.gl, array = gl.createVertexArray(), colors = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, colors);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, 0, 0);
    return {array, colors, count: corners.length / 3};
  }

  /// 4 bytes for each corner of mesh `k`.
  setColors(k, bytes) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.meshes[k].colors);
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    this.draw();
  }

  /// All of both meshes, from a little above.
  whole() {
    this.target = [0, 0, 0];
    this.zoom = .95 / this.radius;
    this.turn = multiply(rotation(0, .3), rotation(1, -.5));
    this.marked = -1;
    this.front = 1e9;
    this.draw();
  }

  /// Triangle `f` of the output in the middle, seen from outside, without what is in front of it.
  /// [a, b, c]: its corners.
  show(f, [a, b, c]) {
    const minus = (p, q) => p.map((x, i) => x - q[i]);
    const u = unit(minus(b, a)), n = unit(cross(u, minus(c, a))), v = cross(n, u);
    this.turn = [u[0], v[0], n[0], u[1], v[1], n[1], u[2], v[2], n[2]];
    this.target = a.map((x, i) => (x + b[i] + c[i]) / 3);
    this.zoom = .35 / Math.max(...[minus(b, a), minus(c, a), minus(c, b)].map(length));
    this.marked = f;
    this.front = .5 / this.zoom;
    this.draw();
  }

  draw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.drawNow(); });
  }

  drawNow() {
    const gl = this.gl, canvas = this.canvas, scale = window.devicePixelRatio || 1;
    canvas.width = canvas.clientWidth * scale;
    canvas.height = canvas.clientHeight * scale;
    const width = Math.floor(canvas.width / 2), height = canvas.height;
    const least = Math.min(width, height);
    gl.clearColor(.957, .961, .969, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.useProgram(this.program);
    gl.uniformMatrix3fv(this.uniforms.turn, false, this.turn);
    gl.uniform3fv(this.uniforms.target, this.target);
    gl.uniform2f(this.uniforms.zoom, this.zoom * least / width, this.zoom * least / height);
    gl.uniform1f(this.uniforms.lines, this.lines);
    gl.uniform1f(this.uniforms.front, this.front);
    [0, this.right].forEach((k, place) => {
      const mesh = this.meshes[k];
      gl.viewport(place * (canvas.width - width), 0, width, height);
      gl.bindVertexArray(mesh.array);
      gl.uniform1i(this.uniforms.fans, k === 2);
      gl.uniform1f(this.uniforms.mark, 0);
      gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
      if (k !== 1 || this.marked < 0) return;
      gl.uniform1f(this.uniforms.mark, 1);
      gl.drawArrays(gl.TRIANGLES, 3 * this.marked, 3);
    });
  }

  turnBy(x, y) {
    this.turn = multiply(multiply(rotation(0, y), rotation(1, x)), this.turn);
    this.draw();
  }

  /// By (x, y) pixels.
  moveBy(x, y) {
    const size = Math.min(this.canvas.clientWidth / 2, this.canvas.clientHeight) * this.zoom / 2;
    const t = this.turn;
    this.target = this.target.map((p, i) => p - (t[3 * i] * x - t[3 * i + 1] * y) / size);
    this.draw();
  }

  zoomBy(factor) {
    this.zoom = Math.min(1e5, Math.max(.2, this.zoom * factor));
    this.draw();
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", e => canvas.setPointerCapture(e.pointerId));
    canvas.addEventListener("pointermove", e => {
      if (!canvas.hasPointerCapture(e.pointerId)) return;
      if (e.shiftKey || e.buttons > 1) this.moveBy(e.movementX, e.movementY);
      else this.turnBy(e.movementX / 150, e.movementY / 150);
    });
    canvas.addEventListener("contextmenu", e => e.preventDefault());
    canvas.addEventListener("wheel", e => {
      e.preventDefault();
      this.zoomBy(Math.exp(-e.deltaY / 500));
    }, {passive: false});
    canvas.addEventListener("keydown", e => {
      const step = {ArrowLeft: [-.1, 0], ArrowRight: [.1, 0], ArrowUp: [0, -.1],
                    ArrowDown: [0, .1]}[e.key];
      if (step) this.turnBy(...step);
      else if (e.key === "+" || e.key === "-") this.zoomBy(e.key === "+" ? 1.2 : 1 / 1.2);
      else return;
      e.preventDefault();
    });
    new ResizeObserver(() => this.drawNow()).observe(canvas); // before the new size is shown
  }
}

// Vectors, and 3 by 3 matrices by columns.
const length = p => Math.hypot(...p);
const unit = p => p.map(x => x / (length(p) || 1));
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                         p[0] * q[1] - p[1] * q[0]];
function multiply(a, b) {
  const c = new Array(9).fill(0);
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j)
      for (let k = 0; k < 3; ++k) c[3 * j + i] += a[3 * k + i] * b[3 * j + k];
  return c;
}
/// About the axis x (0) or y (1).
function rotation(axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return axis === 0 ? [1, 0, 0, 0, c, s, 0, -s, c] : [c, 0, -s, 0, 1, 0, s, 0, c];
}

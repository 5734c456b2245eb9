// Draws grains and chains by WebGL 2: a square for each, on which the fragment shader meets the
// sphere or the cylinder with the line of sight, so that outlines and depths are exact. The view is
// orthographic: equal grains are equally large wherever they are.
const branchcrushDraw = (() => {
  "use strict";
  const HEAD = "#version 300 es\nprecision highp float;\n";
  // What lies on the far side of the cut plane is kept: n.p <= d, in view axes.
  const CUT = "uniform vec4 cut;\nbool gone(vec3 p) { return dot(cut.xyz, p) > cut.w; }\n";
  const LIGHT = "const vec3 LIGHT = vec3(-0.45, 0.55, 0.7);\n";

  // Four vertices one after the other are a square. Instances of four vertices would need a quarter of
  // the memory, but take 40 µs each where the processor draws.
  const CORNER = "vec2 at_corner() { return vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0; }\n";

  const GRAIN_VERTEX = HEAD + CORNER + `
    in vec3 centre; in float radius; in vec3 colour;
    uniform mat3 turn; uniform vec2 scale;
    out vec2 q; flat out vec3 c; flat out float r; flat out vec3 tint;
    void main() {
      vec2 corner = at_corner();
      c = turn * centre; q = corner; r = radius; tint = colour;
      gl_Position = vec4((c.xy + corner * radius) * scale, 0.0, 1.0);
    }`;
  const GRAIN_FRAGMENT = HEAD + CUT + LIGHT + `
    in vec2 q; flat in vec3 c; flat in float r; flat in vec3 tint;
    uniform float deep; uniform float alpha;
    out vec4 drawn;
    void main() {
      float s = dot(q, q);
      if (s > 1.0) discard;
      float h = sqrt(1.0 - s);
      vec3 p = vec3(c.xy + q * r, c.z + h * r);
      float lit = (0.45 + 0.6 * max(dot(vec3(q, h), normalize(LIGHT)), 0.0)) * (0.55 + 0.45 * sqrt(h));
      if (gone(p)) {
        // The cut face of the grain, where the line of sight meets the plane inside of it.
        if (cut.z < 1e-4) discard;
        float z = (cut.w - dot(cut.xy, p.xy)) / cut.z;
        if (z < c.z - h * r) discard;
        p.z = z; lit = 0.92;
      }
      gl_FragDepth = clamp(0.5 - 0.5 * p.z * deep, 0.0, 1.0);
      drawn = vec4(min(tint * lit, 1.0), alpha);
    }`;
  const CHAIN_VERTEX = HEAD + CORNER + `
    in vec3 from; in vec3 to; in float force;
    uniform mat3 turn; uniform vec2 scale; uniform float widest; uniform float pixel;
    out float across; out vec3 p; flat out float half_width;
    void main() {
      vec2 corner = at_corner();
      vec3 a = turn * from, b = turn * to;
      half_width = max(force * widest, 0.6 * pixel);
      vec2 d = b.xy - a.xy;
      float l = length(d);
      vec2 along = l > 0.0 ? d / l : vec2(1.0, 0.0);
      across = corner.y;
      // Ends reach half a width beyond the centre, so that chains bend without gaps.
      p = mix(a, b, corner.x * 0.5 + 0.5);
      p.xy += along * corner.x * half_width * 0.5 + vec2(-along.y, along.x) * corner.y * half_width;
      gl_Position = vec4(p.xy * scale, 0.0, 1.0);
    }`;
  const CHAIN_FRAGMENT = HEAD + CUT + `
    in float across; in vec3 p; flat in float half_width;
    uniform float deep; uniform vec3 tint;
    out vec4 drawn;
    void main() {
      float h = sqrt(max(1.0 - across * across, 0.0));
      vec3 at = p + vec3(0.0, 0.0, h * half_width);
      if (gone(at)) discard;
      gl_FragDepth = clamp(0.5 - 0.5 * at.z * deep, 0.0, 1.0);
      drawn = vec4(tint * (0.55 + 0.45 * h), 1.0);
    }`;
  const EDGE_VERTEX = HEAD + `
    in vec3 centre; uniform mat3 turn; uniform vec2 scale; uniform float deep;
    void main() {
      vec3 p = turn * centre;
      gl_Position = vec4(p.xy * scale, clamp(-p.z * deep, -1.0, 1.0), 1.0);
    }`;
  const EDGE_FRAGMENT = HEAD + "uniform vec3 tint; out vec4 drawn;\nvoid main() { drawn = vec4(tint, 1.0); }";

  function program(gl, vertex, fragment) {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`the grains cannot be drawn: ${gl.getProgramInfoLog(made)}`);
    return { made, at: (name) => gl.getUniformLocation(made, name) };
  }

  // Null where the browser has no WebGL 2.
  function renderer(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: false, stencil: false });
    if (!gl) return null;
    const grains = program(gl, GRAIN_VERTEX, GRAIN_FRAGMENT);
    const chains = program(gl, CHAIN_VERTEX, CHAIN_FRAGMENT);
    const edges = program(gl, EDGE_VERTEX, EDGE_FRAGMENT);
    const buffers = {};
    const count = { grains: 0, chains: 0 };

    function fill(name, values) {
      buffers[name] ??= gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    }

    // The same numbers for the four vertices of each square.
    function fillSquares(name, values, size) {
      const four = new values.constructor(4 * values.length);
      for (let k = 0; k < 4 * values.length; k += size)
        for (let m = 0; m < size; m++) four[k + m] = values[Math.floor(k / size / 4) * size + m];
      fill(name, four);
    }

    // Two triangles for each of as many squares as have been needed so far.
    let squares = 0;
    const order = gl.createBuffer();
    function needSquares(number) {
      if (number <= squares) return;
      squares = number;
      const corners = [0, 1, 2, 2, 1, 3];
      const all = Uint32Array.from({ length: 6 * number }, (_, k) => 4 * Math.floor(k / 6) + corners[k % 6]);
      gl.bindVertexArray(null);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, order);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, all, gl.STATIC_DRAW);
    }

    // Attributes of a program: name, buffer, numbers, type, stride and offset in bytes.
    function layout(used, parts) {
      const vao = gl.createVertexArray();
      gl.bindVertexArray(vao);
      for (const [name, buffer, size, type, stride, offset] of parts) {
        const at = gl.getAttribLocation(used.made, name);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffers[buffer]);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, order);
      return vao;
    }

    for (const name of ["places", "colours", "ends", "forces", "box"]) fill(name, new Float32Array(0));
    const F = gl.FLOAT, U = gl.UNSIGNED_BYTE;
    const grainLayout = layout(grains, [["centre", "places", 3, F, 16, 0], ["radius", "places", 1, F, 16, 12],
      ["colour", "colours", 3, U, 0, 0]]);
    const chainLayout = layout(chains, [["from", "ends", 3, F, 24, 0], ["to", "ends", 3, F, 24, 12],
      ["force", "forces", 1, F, 0, 0]]);
    const edgeLayout = layout(edges, [["centre", "box", 3, F, 0, 0]]);

    function common(used, view) {
      gl.useProgram(used.made);
      gl.uniformMatrix3fv(used.at("turn"), false, view.turn);
      gl.uniform2fv(used.at("scale"), view.scale);
      gl.uniform1f(used.at("deep"), view.deep);
      gl.uniform4fv(used.at("cut"), view.cut);
    }

    function drawGrains(view, alpha) {
      common(grains, view);
      gl.uniform1f(grains.at("alpha"), alpha);
      gl.bindVertexArray(grainLayout);
      gl.drawElements(gl.TRIANGLES, 6 * count.grains, gl.UNSIGNED_INT, 0);
    }

    function draw(view) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0, 0, 0, 0);
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
      gl.disable(gl.BLEND);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      common(edges, view);
      gl.uniform3fv(edges.at("tint"), view.line);
      gl.bindVertexArray(edgeLayout);
      gl.drawArrays(gl.LINES, 0, 24);
      if (view.chains) {
        common(chains, view);
        gl.uniform1f(chains.at("widest"), view.widest);
        gl.uniform1f(chains.at("pixel"), view.pixel);
        gl.uniform3fv(chains.at("tint"), view.chain);
        gl.bindVertexArray(chainLayout);
        gl.drawElements(gl.TRIANGLES, 6 * count.chains, gl.UNSIGNED_INT, 0);
      }
      if (!view.grains) return;
      if (!view.chains) return drawGrains(view, 1);
      // The nearest surface alone, as a veil over the chains: first its depth, then its colour.
      gl.clear(gl.DEPTH_BUFFER_BIT);
      gl.colorMask(false, false, false, false);
      drawGrains(view, 1);
      gl.colorMask(true, true, true, true);
      gl.enable(gl.BLEND);
      gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      drawGrains(view, 0.3);
    }

    return {
      draw,
      // Waits until the picture is made, so that its time can be told.
      finish: () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),
      setGrains(s) {
        count.grains = s.row.grains;
        const places = new Float32Array(4 * count.grains);
        for (let k = 0; k < count.grains; k++) places.set([s.x[k], s.y[k], s.z[k], s.radius[k]], 4 * k);
        needSquares(count.grains);
        fillSquares("places", places, 4);
      },
      setBox: (ends) => fill("box", ends),
      setColours: (colours) => fillSquares("colours", colours, 3),
      setChains(chain) {
        count.chains = chain.force.length;
        needSquares(count.chains);
        fillSquares("ends", chain.ends, 6);
        fillSquares("forces", chain.force, 1);
      },
      // A page may have but some 16 of these at once.
      dispose: () => gl.getExtension("WEBGL_lose_context")?.loseContext(),
    };
  }

  return { renderer };
})();

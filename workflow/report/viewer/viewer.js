// A view of the grains for each figure of class "viewer": begun when it is scrolled into view, ended
// when it leaves, drawn only when something changes.
(() => {
  "use strict";
  const D = branchcrushData;
  const FIRST = { turn: 0.61, tilt: 0.38, zoom: 1 };

  function begin(figure) {
    const find = (name) => figure.querySelector(name);
    const live = find(".viewer-live");
    if (!live) return;
    const header = JSON.parse(find(".viewer-header").textContent);
    const stage = find(".viewer-stage"), why = find(".viewer-why"), still = find(".viewer-still");
    const control = (name) => live.querySelector(`[name=${name}]`);
    const [slider, mode, axis, cut] = ["state", "mode", "axis", "cut"].map(control);
    const camera = { ...FIRST };
    const scaleBar = document.createElement("div");
    scaleBar.className = "viewer-scale";
    // ms: what a picture takes at the screen's own resolution.
    let numbers, shown, painter = null, canvas, waiting = 0, rest = 0, ms = 0, moving = false, frames = 0;

    function open() {
      if (painter) return;
      canvas = document.createElement("canvas");
      canvas.setAttribute("aria-hidden", "true");
      try {
        painter = branchcrushDraw.renderer(canvas);
      } catch (error) {
        return fall(error.message);
      }
      if (!painter) return fall("this browser draws no WebGL 2");
      canvas.addEventListener("webglcontextlost", lost);
      numbers ??= D.words(find(".viewer-data").textContent.trim());
      live.hidden = false;
      why.hidden = still.hidden = true;
      stage.replaceChildren(canvas, scaleBar);
      show();
      figure.dataset.drawn = "live";
    }

    function fall(reason) {
      painter = null;
      live.hidden = true;
      why.hidden = still.hidden = false;
      why.textContent = `A still picture: ${reason}.`;
      figure.dataset.drawn = "still";
    }

    function lost(event) {
      event.preventDefault();
      close();
      open();
    }

    // The stage keeps its size, so that the page does not jump.
    function close() {
      if (!painter) return;
      canvas.removeEventListener("webglcontextlost", lost);
      painter.dispose();
      painter = null;
      figure.dataset.drawn = "closed";
    }

    function show() {
      shown = D.state(header, numbers, Number(slider.value));
      painter.setGrains(shown);
      painter.setBox(D.box(shown.row.cell_m));
      const chains = D.chains(header, shown);
      const largest = chains.force.reduce((a, b) => Math.max(a, b), 0);
      shown.largest = largest * (header.scales.force ? header.scales.force[1] : 0);
      painter.setChains({ ends: chains.ends, force: chains.force.map((f) => (largest ? f / largest : 0)) });
      const row = shown.row;
      const stress = row.mean_stress_Pa / 1e6;
      find(".viewer-state").textContent = `state ${row.state}, ${row.label}: φ = ${row.solid_fraction.toFixed(3)}, ` +
        `mean stress ${Math.abs(stress) >= 0.1 ? `${D.number(stress)} MPa` : `${D.number(row.mean_stress_Pa)} Pa`}, ` +
        `${row.grains} grain${row.grains === 1 ? "" : "s"}, ${row.contacts} contact${row.contacts === 1 ? "" : "s"}`;
      slider.setAttribute("aria-valuetext", find(".viewer-state").textContent);
      paint();
    }

    function paint() {
      painter.setColours(D.colours(header, shown, mode.value));
      legend();
      redraw();
    }

    function legend() {
      const { label, unit, none } = D.MODES[mode.value], parts = [];
      const swatch = (colour, text) => `<span class="viewer-swatch"><i style="background:rgb(${colour.join(" ")})"></i>${text}</span>`;
      if (mode.value === "generation")
        parts.push("generation:", ...D.GENERATIONS.map((c, k) => swatch(c, D.GENERATION_WORDS[k])));
      else {
        const bar = D.bar(header, mode.value);
        parts.push(bar ? `<span>${label} [${unit}]</span><span class="viewer-gradient"><i style="background:linear-gradient(90deg,${bar.stops.join()})"></i>` +
          `<span>${bar.values.map((v) => `<b>${v}</b>`).join("")}</span></span>` : `no grain has any ${label}`);
        if (none) parts.push(swatch(D.NONE, none));
      }
      if (control("chains").checked)
        parts.push(`<span class="viewer-swatch viewer-line"><i></i>${shown.largest
          ? `width by force, widest ${D.number(shown.largest)} N in this state` : "no contact carries force in this state"}</span>`);
      find(".viewer-bar").innerHTML = parts.join(" ");
    }

    // While it moves it is drawn coarser where that is slow, at rest finer where that is quick.
    function ratio() {
      const own = window.devicePixelRatio || 1;
      if (moving) return ms > 60 ? own / 2 : own;
      return ms > 150 ? own : Math.max(own, 2);
    }

    function redraw() {
      if (!painter || waiting) return;
      figure.dataset.busy = true;
      waiting = requestAnimationFrame(() => {
        waiting = 0;
        if (painter) draw();
      });
    }

    function move() {
      moving = true;
      clearTimeout(rest);
      rest = setTimeout(() => { moving = false; redraw(); }, 150);
      redraw();
    }

    function draw() {
      const width = stage.clientWidth, height = stage.clientHeight, by = ratio();
      if (!width || !height) return;
      const size = [Math.round(width * by), Math.round(height * by)];
      if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
      const cell = shown.row.cell_m;
      // Metres to half the height of the view: in the first one the cell has a rim about it.
      const [right, up] = axes(turned(FIRST)).map((n) =>
        0.55 * Math.max(D.width(cell, n), D.width(header.states.at(-1).cell_m, n)));
      const reach = Math.max(up, right * height / width) / camera.zoom;
      const turn = turned(camera), style = getComputedStyle(figure);
      const across = [0, 1, 2].map((k) => Number(k === Number(axis.value)));
      const n = axis.value === "" ? null : [0, 1, 2].map((k) => turn[3 * Number(axis.value) + k]);
      // Of the two sides the one toward the eye is taken away.
      const side = n && n[2] < 0 ? -1 : 1;
      const started = performance.now();
      painter.draw({
        turn, scale: [height / width / reach, 1 / reach], deep: 0.35 / shown.row.span_m,
        cut: n ? [...n.map((v) => side * v), side * Number(cut.value) * D.width(cell, across)] : [0, 0, 0, 1],
        grains: control("grains").checked, chains: control("chains").checked,
        widest: 0.012 * D.size(cell), pixel: 2 * reach / size[1],
        line: colour(style, "--soft"), chain: colour(style, "--chain"),
      });
      painter.finish();
      ms = (performance.now() - started) * (window.devicePixelRatio / by) ** 2;
      measure(reach, height);
      Object.assign(figure.dataset, { frames: ++frames, ms: (performance.now() - started).toFixed(1), busy: moving });
    }

    function measure(reach, height) {
      const metres = 2 * reach / height, most = 0.3 * stage.clientWidth * metres * 1e3;
      const power = 10 ** Math.floor(Math.log10(most));
      const length = [5, 2, 1].map((k) => k * power).find((l) => l <= most);
      scaleBar.style.width = `${length / 1e3 / metres}px`;
      scaleBar.textContent = `${D.number(length)} mm`;
    }

    function turnBy(x, y) {
      camera.turn += x;
      camera.tilt = Math.min(Math.max(camera.tilt + y, -Math.PI / 2), Math.PI / 2);
      move();
    }

    function zoomBy(factor) {
      camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.3), 200);
      move();
    }

    // Mouse and fingers: one turns, two zoom.
    const down = new Map();
    const spread = () => {
      const [a, b] = [...down.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    stage.addEventListener("pointerdown", (event) => {
      down.set(event.pointerId, { x: event.clientX, y: event.clientY });
      stage.setPointerCapture?.(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
      const before = down.get(event.pointerId);
      if (!before) return;
      const apart = down.size === 2 ? spread() : 0;
      down.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (down.size === 1) turnBy((before.x - event.clientX) * 0.01, (event.clientY - before.y) * 0.01);
      else if (apart) zoomBy(spread() / apart);
    });
    for (const kind of ["pointerup", "pointercancel", "lostpointercapture"])
      stage.addEventListener(kind, (event) => down.delete(event.pointerId));
    stage.addEventListener("click", () => stage.focus({ preventScroll: true }));
    stage.addEventListener("wheel", (event) => {
      if (document.activeElement !== stage && !event.ctrlKey) return;
      event.preventDefault();
      zoomBy(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
    }, { passive: false });

    const step = (input, by) => {
      input.value = Number(input.value) + by;
      input.dispatchEvent(new Event("input"));
    };
    const flip = (name) => control(name).click();
    const cutAcross = (value) => {
      axis.value = axis.value === value ? "" : value;
      axis.dispatchEvent(new Event("change"));
    };
    const KEYS = {
      ArrowLeft: () => turnBy(0.1, 0), ArrowRight: () => turnBy(-0.1, 0),
      ArrowUp: () => turnBy(0, -0.1), ArrowDown: () => turnBy(0, 0.1),
      "+": () => zoomBy(1.15), "=": () => zoomBy(1.15), "-": () => zoomBy(1 / 1.15),
      0: () => flip("reset"), "[": () => step(slider, -1), "]": () => step(slider, 1),
      c: () => { mode.selectedIndex = (mode.selectedIndex + 1) % mode.length; paint(); },
      g: () => flip("grains"), f: () => flip("chains"),
      x: () => cutAcross("0"), y: () => cutAcross("1"), z: () => cutAcross("2"),
      ",": () => step(cut, -0.02), ".": () => step(cut, 0.02),
    };
    stage.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !KEYS[event.key]) return;
      event.preventDefault();
      KEYS[event.key]();
    });

    slider.addEventListener("input", () => painter && show());
    mode.addEventListener("change", () => painter && paint());
    control("grains").addEventListener("change", redraw);
    control("chains").addEventListener("change", () => { if (painter) { legend(); redraw(); } });
    axis.addEventListener("change", () => { cut.disabled = axis.value === ""; redraw(); });
    cut.addEventListener("input", move);
    control("reset").addEventListener("click", () => { Object.assign(camera, FIRST); move(); });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
    new ResizeObserver(redraw).observe(stage);
    new IntersectionObserver((seen) => (seen.at(-1).isIntersecting ? open() : close()),
      { rootMargin: "200px" }).observe(figure);
  }

  // Axes of the view from those of the cell, columns of the matrix: right, up, toward the eye.
  function turned({ turn, tilt }) {
    const [c, s, ct, st] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    return Float32Array.of(c, -st * s, ct * s, s, st * c, -ct * c, 0, ct, st);
  }

  // The same as rows: right, up, toward the eye.
  function axes(turn) {
    return [0, 1, 2].map((row) => [0, 1, 2].map((k) => turn[3 * k + row]));
  }

  function colour(style, name) {
    const hex = style.getPropertyValue(name).trim().slice(1);
    const full = hex.length === 3 ? [...hex].map((d) => d + d).join("") : hex;
    return [0, 2, 4].map((k) => parseInt(full.slice(k, k + 2), 16) / 255);
  }

  const all = () => document.querySelectorAll(".viewer").forEach(begin);
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", all);
  else all();
})();

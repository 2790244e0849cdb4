// Components of the page of `oilfilm app`: shell (address, files, keys), control, map.
(function () {
  const trigger = (name, args) => window.trame.trigger(name, args || []);

  const shell = {
    props: ["address", "file", "dark", "title"],
    render() { return null; },
    mounted() {
      const dark = window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches;
      if (dark !== this.dark) trigger("theme", [dark]);
      trigger("opened", [decodeHash(window.location.hash)]);
      window.addEventListener("keydown", this.keys);
      window.addEventListener("hashchange", this.moved);
      document.documentElement.lang = "en";
    },
    unmounted() {
      window.removeEventListener("keydown", this.keys);
      window.removeEventListener("hashchange", this.moved);
    },
    methods: {
      keys(event) {
        if (!(event.ctrlKey || event.metaKey)) return;
        const key = event.key.toLowerCase();
        if (key === "z" || key === "y") {
          event.preventDefault();
          trigger("step", [key === "y" || event.shiftKey ? 1 : -1]);
        }
      },
      moved() { trigger("opened", [decodeHash(window.location.hash)]); },
    },
    watch: {
      address(value) { if (value) window.history.replaceState(null, "", window.location.pathname + keptQuery + "#" + value); },
      title(value) { document.title = value + " – oilfilm"; },
      file(value) {
        if (!value || !value.name) return;
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob([value.text], { type: "text/plain" }));
        link.download = value.name;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
      },
    },
  };

  const keptQuery = window.location.search; // with the token, which trame takes out

  function decodeHash(hash) { return hash.replace(/^#/, ""); }

  const control = {
    props: ["spec", "value", "revision", "error", "given"],
    data() { return { own: this.value }; },
    watch: {
      revision() { this.own = this.value; },
      value(v) { this.own = v; },
    },
    computed: {
      id() { return "c-" + this.spec.key.replace(/\W/g, "-"); },
      idle() { return this.spec.key === "operation.temperature_C" && this.given === "self-heated"; },
      track() {
        const { min, max, range } = this.spec;
        if (!range.length) return {};
        const at = (v) => (100 * Math.min(Math.max((v - min) / (max - min), 0), 1)).toFixed(1) + "%";
        return { "--low": at(range[0]), "--high": at(range[1]) };
      },
      shown() { return this.own === null || this.own === undefined ? "" : this.own; },
      inside() {
        const v = Number(this.own);
        return Number.isFinite(v) ? Math.min(Math.max(v, this.spec.min), this.spec.max) : this.spec.min;
      },
      tip() {
        const s = this.spec;
        return [s.help, s.source && "source: " + s.source, s.allowed && "allowed: " + s.allowed, s.key].filter(Boolean).join("\n");
      },
    },
    methods: {
      send(value) { this.own = value; trigger("set", [this.spec.key, value]); },
      slide(event) { this.send(Number(event.target.value)); },
      type(event) { this.send(event.target.value); },
    },
    template: `
      <div class="control" :class="{bad: error, idle: idle}" :data-key="spec.key" :title="tip">
        <div class="line">
          <label :for="id">{{ spec.label }}</label>
          <span v-if="spec.mark" class="mark">{{ spec.mark }}</span>
          <span class="grow"></span>
          <template v-if="!spec.options.length">
            <input :class="spec.text ? 'words' : 'number'" :id="id" :value="shown" @change="type" :inputmode="spec.text ? 'text' : 'decimal'" autocomplete="off" :list="spec.text ? 'bearings' : null"
              :aria-invalid="error ? 'true' : 'false'" :aria-describedby="error ? id + '-e' : null">
            <span class="unit">{{ spec.unit }}</span>
          </template>
        </div>
        <select v-if="spec.options.length" :id="id" :value="shown" @change="type">
          <option v-for="one in spec.options" :key="one" :value="one">{{ one }}</option>
          <option v-if="!spec.options.includes(shown)" :value="shown">{{ shown }}</option>
        </select>
        <input v-else-if="!spec.text" type="range" :min="spec.min" :max="spec.max" :step="spec.step" :value="inside" @input="slide"
          :style="track" :class="{ranged: spec.range.length}" :aria-label="spec.label + ', slider'">
        <p v-if="error" class="error" role="alert" :id="id + '-e'">{{ error }}</p>
      </div>`,
  };

  const SHADES = [[68,1,84],[72,40,120],[62,74,137],[49,104,142],[38,130,142],[31,158,137],[53,183,121],[109,205,89],[180,222,44],[253,231,37]];
  function shade(t) {
    const x = Math.min(Math.max(t, 0), 1) * (SHADES.length - 1);
    const i = Math.min(Math.floor(x), SHADES.length - 2), f = x - i;
    return "rgb(" + SHADES[i].map((c, k) => Math.round(c + f * (SHADES[i + 1][k] - c))).join(",") + ")";
  }
  const LOGARITHMIC = ["lambda", "film_um", "torque_N_mm", "life_h"];
  const figure = (v) => v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(1) : String(Number(v.toPrecision(3)));

  function ticks(a, b) {
    const low = Math.min(a, b), high = Math.max(a, b), power = 10 ** Math.floor(Math.log10((high - low) / 5));
    const step = [1, 2, 5, 10].map((n) => n * power).find((s) => (high - low) / s <= 6);
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
  }

  const map = {
    props: ["data", "shown", "quantities", "axes", "values", "dark"],
    data() { return { hover: "" }; },
    mounted() {
      this.draw();
      this.observer = new ResizeObserver(() => this.draw());
      this.observer.observe(this.$refs.box);
    },
    unmounted() { this.observer.disconnect(); },
    watch: { data() { this.draw(); }, shown() { this.draw(); }, dark() { this.draw(); }, values() { this.draw(); } },
    methods: {
      label(key) {
        const axis = this.axes.find((a) => a.key === key);
        return axis && axis.unit ? axis.label + " [" + axis.unit + "]" : axis ? axis.label : key;
      },
      room() {
        const w = this.$refs.box.clientWidth, h = Math.max(Math.min(w * 0.72, 560), 240);
        return { w, h, left: 64, right: w - 92, top: 14, bottom: h - 46 };
      },
      draw() {
        const canvas = this.$refs.canvas; if (!canvas) return;
        const r = this.room(), ratio = window.devicePixelRatio || 1;
        canvas.width = r.w * ratio; canvas.height = r.h * ratio; canvas.style.height = r.h + "px";
        const g = canvas.getContext("2d"); g.scale(ratio, ratio);
        const style = getComputedStyle(this.$refs.box), ink = style.getPropertyValue("--ink"), line = style.getPropertyValue("--line");
        g.clearRect(0, 0, r.w, r.h); g.font = "12px system-ui, sans-serif"; g.fillStyle = ink; g.strokeStyle = line;
        g.strokeRect(r.left, r.top, r.right - r.left, r.bottom - r.top);
        const d = this.data; if (!d || !d.points || !d.points.length) return;
        const q = Number(this.shown), log = LOGARITHMIC.includes(this.quantities[q].key);
        const good = d.points.filter((p) => p[3][q] !== null && (!log || p[3][q] > 0));
        const scale = (v) => log ? Math.log(v) : v;
        const values = good.map((p) => scale(p[3][q]));
        const low = Math.min(...values), high = Math.max(...values), width = high - low || 1;
        const cw = (r.right - r.left) / d.n, ch = (r.bottom - r.top) / d.n;
        for (const p of [...d.points].sort((a, b) => b[2] - a[2])) {
          const half = Math.floor(p[2] / 2), i0 = p[0] - half, j0 = p[1] - half;
          const n = Math.min(p[2], d.n - i0), m = Math.min(p[2], d.n - j0);
          const ok = p[3][q] !== null && (!log || p[3][q] > 0);
          g.fillStyle = ok ? shade((scale(p[3][q]) - low) / width) : line;
          g.fillRect(r.left + i0 * cw, r.bottom - (j0 + m) * ch, n * cw + 0.5, m * ch + 0.5);
        }
        g.fillStyle = ink; g.textAlign = "center";
        const x = (v) => r.left + (0.5 + (d.n - 1) * (v - d.x[0]) / (d.x[d.n - 1] - d.x[0])) * cw;
        const y = (v) => r.bottom - (0.5 + (d.n - 1) * (v - d.y[0]) / (d.y[d.n - 1] - d.y[0])) * ch;
        for (const v of ticks(d.x[0], d.x[d.n - 1])) g.fillText(figure(v), x(v), r.bottom + 16);
        g.textAlign = "right";
        for (const v of ticks(d.y[0], d.y[d.n - 1])) g.fillText(figure(v), r.left - 6, y(v) + 4);
        g.textAlign = "center";
        g.fillText(this.label(d.keys[0]), (r.left + r.right) / 2, r.bottom + 36);
        g.save(); g.translate(14, (r.top + r.bottom) / 2); g.rotate(-Math.PI / 2); g.fillText(this.label(d.keys[1]), 0, 0); g.restore();
        for (let k = 0; k < 64; k++) { g.fillStyle = shade(k / 63); g.fillRect(r.right + 14, r.bottom - (k + 1) * (r.bottom - r.top) / 64, 12, (r.bottom - r.top) / 64 + 1); }
        g.fillStyle = ink; g.textAlign = "left";
        for (const k of [0, 0.5, 1]) { const v = low + k * width; g.fillText(figure(log ? Math.exp(v) : v), r.right + 32, r.bottom - k * (r.bottom - r.top) + (k === 1 ? 10 : k === 0 ? 0 : 4)); }
        const now = [x(Number(this.values[d.keys[0]])), y(Number(this.values[d.keys[1]]))];
        if (now[0] >= r.left && now[0] <= r.right && now[1] >= r.top && now[1] <= r.bottom) {
          for (const [colour, wide] of [["#fff", 3], ["#111", 1]]) {
            g.strokeStyle = colour; g.lineWidth = wide; g.beginPath();
            g.moveTo(now[0], r.top); g.lineTo(now[0], r.bottom); g.moveTo(r.left, now[1]); g.lineTo(r.right, now[1]); g.stroke();
          }
        }
      },
      at(event) {
        const d = this.data; if (!d || !d.points) return null;
        const r = this.room(), box = this.$refs.canvas.getBoundingClientRect();
        const i = Math.floor((event.clientX - box.left - r.left) / ((r.right - r.left) / d.n));
        const j = Math.floor((r.bottom - (event.clientY - box.top)) / ((r.bottom - r.top) / d.n));
        return i < 0 || j < 0 || i >= d.n || j >= d.n ? null : [i, j];
      },
      move(event) {
        const at = this.at(event), d = this.data; this.hover = "";
        if (!at) return;
        const p = d.points.find((one) => one[0] === at[0] && one[1] === at[1]);
        const q = this.quantities[Number(this.shown)];
        const value = !p ? "not yet computed" : p[3][this.shown] === null ? "not converged" : q.label + " " + figure(p[3][this.shown]) + " " + q.unit;
        this.hover = figure(d.x[at[0]]) + " , " + figure(d.y[at[1]]) + ": " + value;
      },
      take(event) { const at = this.at(event); if (at) trigger("take_map_point", [this.data.x[at[0]], this.data.y[at[1]]]); },
    },
    template: `<div ref="box" class="map"><canvas ref="canvas" style="width:100%" @mousemove="move" @mouseleave="hover=''" @click="take" role="img" aria-label="Map of the chosen quantity over two keys"></canvas><p class="hover">{{ hover || "\u00a0" }}</p></div>`,
  };

  window.oilfilm = {
    install(app) {
      app.component("of-shell", shell);
      app.component("of-control", control);
      app.component("of-map", map);
    },
  };
})();

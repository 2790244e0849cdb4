// The viewer of vtk.js leaves its window as `global.renderWindow`. A click shows the numbers of the
// contact whose position on the screen is nearest, if it is near; a drag turns and picks nothing.
(() => {
  const contacts = {{ spots|tojson }}, reach = 40, steady = 4;
  const scene = () => window.global && window.global.renderWindow;
  const nearest = (x, y) => {
    const view = scene().getViews()[0];
    const renderer = scene().getRenderers().find((one) => one.getActors().length);
    const [width, height] = view.getSize();
    const frame = view.getCanvas().getBoundingClientRect();
    let found = null, least = reach;
    for (const contact of contacts) {
      const [u, v] = view.worldToDisplay(...contact.place, renderer);
      const distance = Math.hypot(
        frame.left + (u * frame.width) / width - x,
        frame.bottom - (v * frame.height) / height - y);
      if (distance < least) { found = contact; least = distance; }
    }
    return found;
  };
  const show = (x, y) => {
    const found = scene() && nearest(x, y);
    const box = document.getElementById("numbers");
    box.style.display = found ? "block" : "none";
    box.textContent = found ? found.text : "";
    return found;
  };
  let start = [0, 0];
  window.addEventListener("pointerdown", (e) => { start = [e.clientX, e.clientY]; }, true);
  window.addEventListener("pointerup", (e) => {
    const moved = Math.hypot(e.clientX - start[0], e.clientY - start[1]);
    if (moved < steady) show(e.clientX, e.clientY);
  }, true);
  window.oilfilm = { contacts, show };
})();

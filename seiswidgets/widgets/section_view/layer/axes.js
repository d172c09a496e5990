// The frame, the ticks and the titles.

function drawAxes(group, axes, plane) {
  group.replaceChildren();
  if (!axes.x) return;
  const { width, height, share } = plane;
  element("rect", "frame", group, { x: 0, y: 0, width, height });
  axes.x.pixels.forEach((pixel, i) => {
    const x = pixel / share.x;
    element("line", "tick", group, { x1: x, x2: x, y1: height, y2: height + 5 });
    text("label middle", group, { x, y: height + 17 }, axes.x.labels[i]);
  });
  axes.z.pixels.forEach((pixel, i) => {
    const y = pixel / share.y;
    element("line", "tick", group, { x1: -5, x2: 0, y1: y, y2: y });
    text("label end", group, { x: -8, y: y + 4 }, axes.z.labels[i]);
  });
  text("title middle", group, { x: width / 2, y: height + 35 }, axes.x.title);
  const turned = `translate(${-axes.left + 13} ${height / 2}) rotate(-90)`;
  text("title middle", group, { transform: turned }, axes.z.title);
}

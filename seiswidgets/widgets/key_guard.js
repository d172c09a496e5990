// A hidden view that keeps the key presses in the box that it is a child of.

function render({ el }) {
  return keepKeys(() => el.parentElement);
}

export default { render };

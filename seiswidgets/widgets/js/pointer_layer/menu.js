// The context menu of a pane: a list of actions at a point, worked by mouse, finger and keyboard.

import { unscaledSize } from "../shared/unscaled.js";

/**
 * Show a menu in place of the one that is open; it closes after a choice, on Escape, and when the focus leaves it.
 *
 * @param {HTMLElement} el the layer
 * @param {string[]} labels
 * @param {import("./types.js").Pixel} position
 * @param {(index: number) => void} choose
 */
export function openMenu(el, labels, position, choose) {
  const open = el.querySelector(":scope > .menu");
  if (open?.contains(document.activeElement)) /** @type {HTMLElement} */ (document.activeElement).blur(); // closes it
  open?.remove();
  const menu = document.createElement("div");
  let isClosed = false;
  let isPressed = false; // a finger that has opened the menu by a long press is lifted over it
  menu.className = "menu";
  menu.setAttribute("role", "menu");
  const items = labels.map((label, index) => {
    const item = document.createElement("button");
    item.setAttribute("role", "menuitem");
    item.textContent = label;
    item.addEventListener("click", ({ detail }) => {
      if (detail && !isPressed) return; // 0 is the keyboard
      close();
      choose(index);
    });
    menu.append(item);
    return item;
  });
  /** @param {boolean} [isKept] whether the focus goes back to the pane */
  function close(isKept = true) {
    if (isClosed) return; // its removal takes the focus out of it
    isClosed = true;
    menu.remove();
    if (isKept) /** @type {SVGElement | null} */ (el.querySelector(".plot"))?.focus({ preventScroll: true });
  }
  menu.addEventListener("pointerdown", () => {
    isPressed = true;
  });
  menu.addEventListener("keydown", (event) => {
    const index = items.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape") close();
    else if (step) items[(index + step + items.length) % items.length].focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  menu.addEventListener("focusout", ({ relatedTarget }) => {
    if (!menu.contains(/** @type {Node | null} */ (relatedTarget))) close(false);
  });
  menu.addEventListener("contextmenu", (event) => event.preventDefault());
  el.append(menu);
  menu.popover = "manual"; // above everything, whatever clips the pane
  menu.showPopover();
  place(menu, el, position);
  items[0]?.focus({ preventScroll: true });
}

/**
 * Put a menu at a position in an element, but inside the window.
 *
 * @param {HTMLElement} menu
 * @param {HTMLElement} el
 * @param {import("./types.js").Pixel} position
 */
function place(menu, el, position) {
  const [box, size] = [el.getBoundingClientRect(), menu.getBoundingClientRect()];
  const scale = box.width / unscaledSize(el).width; // of the page
  const zoom = /** @type {{ currentCSSZoom?: number }} */ (menu).currentCSSZoom ?? 1;
  const [left, top] = [box.left + position.x * scale, box.top + position.y * scale];
  menu.style.left = `${Math.max(0, Math.min(left, window.innerWidth - size.width)) / zoom}px`;
  menu.style.top = `${Math.max(0, Math.min(top, window.innerHeight - size.height)) / zoom}px`;
}

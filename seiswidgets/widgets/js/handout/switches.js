// Switches and buttons for what the panes show.

/**
 * Append a checkbox with a label.
 *
 * @param {HTMLElement} parent
 * @param {string} text
 * @param {boolean} isOn
 * @param {(isOn: boolean) => void} act
 */
export function appendSwitch(parent, text, isOn, act) {
  const label = document.createElement("label");
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = isOn;
  box.addEventListener("change", () => act(box.checked));
  label.append(box, ` ${text}`);
  parent.append(label);
}

/**
 * Append a button.
 *
 * @param {HTMLElement} parent
 * @param {string} text
 * @param {string} name for screen readers
 * @param {() => void} act
 */
export function appendButton(parent, text, name, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.setAttribute("aria-label", name);
  button.title = name;
  button.addEventListener("click", act);
  parent.append(button);
}

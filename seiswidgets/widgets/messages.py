"""How things are said in the app; every text is escaped by who fills it in."""

TROUBLE = '<div role="alert" style="color: var(--jp-error-color1, #b71c1c); line-height: 1.4">{}</div>'
HINT = '<div role="status" style="color: var(--jp-ui-font-color2, #616161); line-height: 1.4">{}</div>'

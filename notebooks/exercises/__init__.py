"""The notebooks' questions: one module for each notebook, the kinds of questions, and the form that asks them."""

from exercises.form import ask, check

__all__ = ["ask", "check"]

"""The notebooks' questions: one module a notebook, what a question is, and the form that asks it."""

from exercises.form import ask

__all__ = ["ask"]

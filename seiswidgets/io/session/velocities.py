"""Velocity models in a session's file."""

from dataclasses import fields
from typing import Any

from seiswidgets.geology.picks import Horizon
from seiswidgets.geology.velocity import ConstantVelocity, LayerCake, LinearVelocity, TimeDepthTable, Velocity
from seiswidgets.io.document import Entry

MODELS = {
    "constant": ConstantVelocity,
    "linear": LinearVelocity,
    "table": TimeDepthTable,
    "layers": LayerCake,
}
TEXTS = ("source", "time_unit", "depth_unit", "x_unit")


def velocity_as_json(velocity: Velocity) -> dict[str, Any]:
    """A velocity model as plain values; TypeError for one of another kind."""
    for name, model in MODELS.items():
        if isinstance(velocity, model):
            values = {field.name: getattr(velocity, field.name) for field in fields(model)}
            return {"model": name} | {key: _plain(value) for key, value in values.items()}
    raise TypeError(f"the velocities of a {type(velocity).__name__} cannot be saved")


def _plain(value: Any) -> Any:
    if isinstance(value, tuple) and value and isinstance(value[0], Horizon):
        return [{"name": one.name, "pieces": [piece.tolist() for piece in one.pieces]} for one in value]
    return value.tolist() if hasattr(value, "tolist") else value


def read_velocity(entry: Entry) -> Velocity:
    """The velocity model of an entry.

    Raises
    ------
    DataError
        If there is no such model, or a value is missing or of another kind.
    SettingError, PickError
        If the values do not make a model.
    """
    if entry["model"].text() not in MODELS:
        raise entry["model"].error(f"one of {', '.join(MODELS)}")
    model = MODELS[entry["model"].text()]
    names = [field.name for field in fields(model) if field.name not in TEXTS]
    texts = {name: entry[name].text() for name in TEXTS if name in entry.members()}
    return model(**{name: _value(entry[name]) for name in names}, **texts)


def _value(entry: Entry) -> Any:
    if not isinstance(entry.value, list):
        return entry.number()
    return [_horizon(item) if isinstance(item.value, dict) else item.number() for item in entry.items()]


def _horizon(entry: Entry) -> Horizon:
    return Horizon(*(piece.points() for piece in entry["pieces"].items()), name=entry["name"].text())

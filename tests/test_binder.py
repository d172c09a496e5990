"""The packages pinned in binder/ satisfy pyproject.toml; without the network. `make binder-check` installs them."""

import tomllib
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
PINS = [Requirement(line) for line in (ROOT / "binder" / "requirements.txt").read_text().splitlines()]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
BINDER = {"python_version": "3.11", "python_full_version": "3.11.9", "sys_platform": "linux"}
BINDER |= {"platform_system": "Linux", "os_name": "posix", "implementation_name": "cpython"}
BINDER |= {"platform_python_implementation": "CPython", "platform_machine": "x86_64"}
AGAIN = "make binder pins anew"


def versions():
    """The pinned version of each package."""
    return {canonicalize_name(pin.name): next(iter(pin.specifier)).version for pin in PINS}


def asked(requirements, extras):
    """Those of some requirements that hold on Binder."""
    found = [Requirement(text) for text in requirements]
    environments = [{**BINDER, "extra": extra} for extra in ("", *extras)]
    return [one for one in found if one.marker is None or any(map(one.marker.evaluate, environments))]


def needed():
    """Requirements of the project and its extra `binder`, with those of the extras that it names."""
    extras = PROJECT["optional-dependencies"]
    waiting, found = [*PROJECT["dependencies"], "seiswidgets[binder]"], []
    for text in waiting:
        requirement = Requirement(text)
        if requirement.name == PROJECT["name"]:
            waiting += [each for extra in sorted(requirement.extras) for each in extras[extra]]
        else:
            found.append(requirement)
    return found


def installed(name):
    """A package that is here, or None."""
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def test_every_line_is_one_exact_version():
    assert len(PINS) == len(versions())
    for pin in PINS:
        assert [one.operator for one in pin.specifier] == ["=="], pin
        assert (pin.url, pin.marker, pin.extras) == (None, None, set()), pin


def test_pins_are_within_the_projects_ranges():
    assert len(needed()) > 10
    for requirement in needed():
        pinned = versions().get(canonicalize_name(requirement.name))
        assert pinned, f"{requirement.name} is not pinned; {AGAIN}"
        assert requirement.specifier.contains(pinned), f"{requirement.name} is pinned to {pinned}; {AGAIN}"


def test_what_the_pinned_packages_need_is_pinned_too():
    waiting, compared = [(canonicalize_name(one.name), one.extras) for one in needed()], set()
    for name, extras in waiting:
        package = installed(name)
        if (name, *sorted(extras)) in compared or not package or package.version != versions()[name]:
            continue  # another version may need other packages
        compared.add((name, *sorted(extras)))
        for requirement in asked(package.requires or (), extras):
            pinned = versions().get(canonicalize_name(requirement.name))
            assert pinned, f"{name} needs {requirement}; {AGAIN}"
            assert requirement.specifier.contains(pinned, prereleases=True), f"{name} needs {requirement}; {AGAIN}"
            waiting.append((canonicalize_name(requirement.name), requirement.extras))
    assert compared


def test_the_python_is_one_that_the_project_takes():
    (name,) = (ROOT / "binder" / "runtime.txt").read_text().split()
    assert name == f"python-{BINDER['python_version']}"
    assert Requirement(f"python{PROJECT['requires-python']}").specifier.contains(BINDER["python_full_version"])

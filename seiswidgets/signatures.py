"""Strict keywords for public functions: a misspelt one is an error that suggests the right one."""

import inspect
from collections.abc import Callable, Iterable
from difflib import get_close_matches
from functools import wraps
from typing import Any, TypeVar, cast, get_args, get_type_hints

Function = TypeVar("Function", bound=Callable[..., Any])


def strict_keywords(function: Function) -> Function:
    """Decorate a public function so that a misspelt keyword is an error that suggests the right one.

    A parameter ``**options: Unpack[SomeTypedDict]`` is listed keyword by keyword in the signature that users see.

    Raises
    ------
    TypeError
        When the function is called with a keyword that it does not have.
    """
    signature = _expanded(inspect.signature(function))

    @wraps(function)
    def call(*arguments: Any, **keywords: Any) -> Any:
        check_keywords(function.__name__, keywords, signature.parameters)
        return function(*arguments, **keywords)

    call.__signature__ = signature  # type: ignore[attr-defined]  # inspect looks for it, functions do not declare it
    return cast(Function, call)


def check_keywords(function: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Raise TypeError for the first keyword that a function does not have.

    Parameters
    ----------
    function : str
        Name of the function or class, for the message.
    given, known : iterables of str
        Keywords of the call, and those that exist.
    """
    known = list(known)
    for keyword in given:
        if keyword not in known:
            similar = get_close_matches(keyword, known, n=1)
            hint = f"did you mean {similar[0]}=?" if similar else f"it takes {', '.join(known)}"
            raise TypeError(f"{function} has no keyword {keyword}=; {hint}")


def _expanded(signature: inspect.Signature) -> inspect.Signature:
    """The signature with the keywords of an unpacked TypedDict in place of ``**options``."""
    parameters = list(signature.parameters.values())
    if not parameters or parameters[-1].kind is not inspect.Parameter.VAR_KEYWORD:
        return signature
    (keywords,) = get_args(parameters.pop().annotation)
    parameters += [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)
        for name, annotation in get_type_hints(keywords).items()
    ]
    return signature.replace(parameters=parameters)

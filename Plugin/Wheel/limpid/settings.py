# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""How the extinction is optimised."""

import dataclasses
import difflib
import operator
import reprlib

from . import _core
from .arguments import choice, require_choice, warn

#: Settings that a preset has values for.
OF_PRESETS = ("view_weight", "light_weight", "clearing_threshold", "regularization_weight",
              "protect_importance", "emphasis", "importance_smoothing", "smoothness")

#: Settings that are one of several words, and the enumeration of the core that has them.
CHOICES = {"method": _core.Method, "mode": _core.Mode, "solver": _core.Solver,
           "derivative": _core.Derivative, "importance_smoothing": _core.ImportanceSmoothing,
           "views": _core.Views, "backend": _core.Backend}

#: Settings that the core has apart from the others.
OF_VIEWS = ("views", "number_of_views", "eye_angle")
APART = (*OF_VIEWS, "warm_start")


def whether(value):
    """A truth value, also as 0 or 1 and as numpy has it."""
    if value not in (0, 1):
        raise ValueError
    return bool(value)


#: How a value becomes one of the kind that a default is of.
CONVERSIONS = {bool: whether, int: operator.index, float: float,
               tuple: lambda value: tuple(map(operator.index, value))}


def wrong_kind(field, value):
    """What to say of a value that is of another kind than the default."""
    return (f"{field.name} is {reprlib.repr(value)} (it must be of the type of "
            f"{field.default!r}, its default). Give such a value.")


@dataclasses.dataclass(frozen=True)
class Settings:
    """What optimize takes beside the scene: names, defaults and ranges are those of the filter
    vtkExtinctionOptimizer, whose documentation says more.

    Weights are dimensionless, not below zero, and belong to normalised coordinates. Defaults are
    those of the preset "Default".
    """

    view_weight: float = 10.0  #: q of Eq. (23); 0 leaves the view as it is
    light_weight: float = 1.0  #: r of Eq. (24); 0 leaves the light as it is
    clearing_threshold: float = 3e-3  #: share of visibility at stake before something is cleared
    regularization_weight: float = 1e-3  #: p of Eq. (22), if clearing_threshold is 0
    mode: str = "joint"  #: one extinction for camera and light, or "separate": one for each
    solver: str = "policy"  #: policy sweeps, or "adam": the paper's, coarse to fine
    maximum_iterations: int = 8  #: of the policy solver
    iterations_per_level: tuple = (32, 32, 64)  #: of Adam: quarter, half, full resolution
    learning_rate: float = 0.05  #: of Adam (0, 1] [majorant]
    tolerance: float = 1e-3  #: stop when the mean change of an iteration is below [majorant]
    maximum_seconds: float = 0.0  #: stop after; 0: no limit [s]
    derivative: str = "volume"  #: exact, or "ray": Eqs. (19)-(20) as printed
    ray_density: float = 1.0  #: rays per voxel and axis on the farthest slice [0.1, 16]
    skip_unneeded: bool = True  #: leave out what provably cannot change the result
    restrict_to_view: bool = False  #: count only what the picture shows
    protect_importance: float = 1.0  #: share of it that may not be removed [0, 1]
    emphasis: float = 0.0  #: how much thicker than the data it may become [0, 1]; 1: the paper
    importance_smoothing: str = "median"  #: without specks, or "off": as it is
    smoothness: float = 0.2  #: how strongly changes are drawn to their neighbours [0, 10]
    views: str = "single_view"  #: for one camera, or "stereo_pair", "orbit": a mean of several
    number_of_views: int = 8  #: of an orbit [1, 360]
    eye_angle: float = 2.0  #: of a stereo pair, as seen from the focal point [0, 180) [degrees]
    temporal_coherence: float = 0.0  #: how strongly it is drawn to `previous`, see optimize
    warm_start: bool = False  #: start from `previous`, see optimize
    backend: str = "auto"  #: or "cpu", "cuda": this or an error
    method: str = "optimized"  #: or "ordinary", "viola_2004", "marchesin_2010", "ament_2017"
    ament_exponent: float = 1.0  #: lambda of "ament_2017", and so on
    ament_regularization: float = 1.0
    ament_occluders: float = 100.0
    ament_background: float = 0.0
    ament_light_occluders: float = 100.0
    ament_light_background: float = 0.0
    ament_smoothing: int = 1

    def __post_init__(self):
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if field.name in CHOICES:
                require_choice(field.name, value, CHOICES[field.name].__members__)
                continue
            try:
                value = CONVERSIONS[type(field.default)](value)
            except (TypeError, ValueError, OverflowError):
                raise ValueError(wrong_kind(field, value)) from None
            object.__setattr__(self, field.name, value)
        if self.regularization_weight != type(self).regularization_weight and \
                self.clearing_threshold > 0:
            warn(f"regularization_weight is {self.regularization_weight:g}, and clearing_threshold "
                 f"{self.clearing_threshold:g} (it replaces the weight, which has no effect). Set "
                 "clearing_threshold=0 to use the weight, or leave the weight out.")

    @classmethod
    def preset(cls, name):
        """Settings for a purpose: "Default", "Keep Context", "Strong Reveal", or "Paper", which has
        the values of the paper. Raises ValueError for a name that there is not."""
        core = _core.settings_of_preset(str(name))
        values = {setting: getattr(core, setting) for setting in OF_PRESETS}
        values["importance_smoothing"] = values["importance_smoothing"].name
        return cls(**values)

    @classmethod
    def of(cls, given):
        """Settings from keyword arguments; preset="Paper" stands for the values of that preset, and
        settings= for those of a Settings, which others replace; a regularization_weight counts.
        Raises TypeError for a name that there is not."""
        names = [field.name for field in dataclasses.fields(cls)]
        start = cls._start(given.get("settings"), given.get("preset"))
        given = {name: value for name, value in given.items() if name not in ("preset", "settings")}
        for name in given:
            if name not in names:
                near = difflib.get_close_matches(name, [*names, "preset", "settings"], 1)
                raise TypeError(f"There is no setting {name!r}" +
                                (f". Did you mean {near[0]!r}?" if near else
                                 f" (help(limpid.Settings) lists all). Use one of these: "
                                 f"{', '.join(names)}."))
        if "regularization_weight" in given:
            given.setdefault("clearing_threshold", 0.0)
        return dataclasses.replace(start, **given)

    @classmethod
    def _start(cls, settings, preset):
        """What other settings replace members of."""
        if settings is None:
            return cls() if preset is None else cls.preset(preset)
        if preset is not None:
            raise ValueError(f"preset {preset!r} and settings are given (each has a value for "
                             "every setting). Give one of them; limpid.Settings.preset(...) and "
                             "dataclasses.replace combine both.")
        if not isinstance(settings, cls):
            raise TypeError(f"settings is {reprlib.repr(settings)} (this is not a settings "
                            "object). Give a limpid.Settings, or settings by their names.")
        return settings

    def in_core(self):
        """The settings as the core has them, whose ranges the core checks. Raises ValueError for a
        value that it cannot hold."""
        settings = _core.Settings()
        for field in dataclasses.fields(self):
            if field.name in APART:
                continue
            value = getattr(self, field.name)
            if field.name in CHOICES:
                value = choice(field.name, value, CHOICES[field.name])
            try:
                setattr(settings, field.name, value)
            except (TypeError, ValueError, OverflowError, RuntimeError):
                raise ValueError(wrong_kind(field, value)) from None
        return settings

    def views_in_core(self):
        """For which cameras the extinction is to be, as the core has it, which checks it."""
        if self.views != "single_view" and self.method != "optimized":
            raise ValueError(f"views is {self.views!r} and method {self.method!r} (only the method "
                             "'optimized' supports several cameras). Use the views 'single_view' "
                             "or the method 'optimized'.")
        try:
            return _core.ViewSet(choice("views", self.views, _core.Views), self.number_of_views,
                                 self.eye_angle)
        except (TypeError, OverflowError):
            raise ValueError(f"number_of_views is {self.number_of_views} (an orbit has 1 to 360 "
                             "views). Give a number in this range.") from None

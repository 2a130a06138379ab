# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A page of trame with a volume that Limpid optimises and draws on the server. Sliders move the
camera and set two settings; browsers get pictures alone.

  python3 trame_viewer.py [--server] [--port 8080] [--host 127.0.0.1]

opens the page, with --server only serves it. It needs the Python package of Plugin/Wheel and trame
(pip install trame), neither VTK nor graphics hardware.
"""

import base64
import math

from trame.app import get_server
from trame.ui.html import DivLayout
from trame.widgets import html

import limpid
import python_package

SIZE = 500  # of the picture [pixels]
DISTANCE = 5.5  # of the camera from the middle of the volume [length]
SLIDERS = (  # name, text, least, most, step, start
    ("azimuth", "Azimuth [degrees]", -180, 180, 5, 40),
    ("elevation", "Elevation [degrees]", -85, 85, 5, 30),
    ("view_weight", "View weight", 0, 30, 1, 10),
    ("protect_importance", "Protect importance", 0, 1, 0.1, 1))
NAMES = tuple(name for name, *_ in SLIDERS)
SCALARS = python_package.phantom(48)


def camera_at(azimuth, elevation):
    """The camera on the sphere round the volume, from two angles [degrees]."""
    round_it, up = math.radians(azimuth), math.radians(elevation)
    position = (math.cos(up) * math.sin(round_it), math.sin(up), math.cos(up) * math.cos(round_it))
    return limpid.Camera(position=[DISTANCE * x for x in position], focal_point=(0, 0, 0))


def drawn(azimuth, elevation, **settings):
    """The optimised volume: a picture as the address of its data, and what can be seen, in words."""
    found = limpid.optimize(
        SCALARS, **python_package.placement(len(SCALARS)), camera=camera_at(azimuth, elevation),
        extinction_function=python_package.EXTINCTION,
        importance_function=python_package.IMPORTANCE, **settings)
    picture = python_package.picture(SCALARS, found.camera, found.extinction, SIZE)
    data = base64.b64encode(limpid.png(picture)).decode()
    return (f"data:image/png;base64,{data}",
            f"{100 * found.visible_fraction:.1f} % of the ring and the ball are visible, "
            f"{100 * found.base_visible_fraction:.1f} % before.")


def serve():
    """Makes the page and serves it."""
    server = get_server(client_type="vue3")
    state = server.state

    @state.change(*NAMES)
    def draw(**values):
        state.picture, state.words = drawn(**{name: float(values[name]) for name in NAMES})

    with DivLayout(server) as layout:
        layout.root.style = "font-family: sans-serif; margin: 1em"
        for name, text, least, most, step, start in SLIDERS:
            with html.Div():
                # A slider is asked when it is released: every picture is optimised anew.
                html.Input(id=name, type="range", min=least, max=most, step=step,
                           value=(name, start), change=f"{name} = Number($event.target.value)")
                html.Label(f"{text}: {{{{ {name} }}}}")
        html.Img(id="picture", src=("picture", ""), width=SIZE, height=SIZE)
        html.Div("{{ words }}", id="words")
    server.start()


if __name__ == "__main__":
    serve()

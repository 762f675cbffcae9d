import os
import sys

import paraview.simple
from paraview.simple import *

# `dygita view` tells where the run is; pvpython tells a script where it is, ParaView's window does not: then it is where the run wrote it.
if "RUN" in globals():
    folder = RUN
else:
    folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.environ.get("DYGITA_RUN", FOLDER)
if not os.path.exists(os.path.join(folder, PROBLEM_FILE)):
    raise RuntimeError("no %s in %s: the run has been moved; open it with dygita view RUN" % (PROBLEM_FILE, folder))

paraview.simple._DisableFirstRenderCameraReset()


def read(name, file):
    """A .pvd of the run's folder, at the instant shown."""
    source = PVDReader(registrationName=name, FileName=os.path.join(folder, file))
    source.UpdatePipeline(TIME)
    return source


def warped(name, source):
    warp = WarpByVector(registrationName=name, Input=source)
    warp.Vectors = ["POINTS", "displacement"]
    warp.ScaleFactor = WARP
    return warp


def colored(view, display, field, title, top, low=0.0):
    """Colours by a point field, from low to top; its legend beside."""
    ColorBy(display, ("POINTS", field) if field != "displacement" else ("POINTS", field, "Magnitude"))
    table = GetColorTransferFunction(field)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.NanColor = [0.8, 0.8, 0.8]
    if top > low:
        table.RescaleTransferFunction(low, top)
        GetOpacityTransferFunction(field).RescaleTransferFunction(low, top)
    bar = GetScalarBar(table, view)
    bar.Title = title
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    display.SetScalarBarVisibility(view, True)


def set_up(view, width):
    view.ViewSize = [width, 720]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]
    view.CameraFocalPoint = CENTRE
    view.CameraPosition = [c + 2.0 * SIZE * e for c, e in zip(CENTRE, EYE)]
    view.CameraViewUp = UP
    view.CameraParallelProjection = 1
    view.CameraParallelScale = HALF_HEIGHT
    return view


def label(view, text, place):
    """A line of text in a corner of a view."""
    words = Text(registrationName=text.split(",")[0].split("\n")[0], Text=text)
    display = Show(words, view)
    display.WindowLocation = place
    display.Color = [0.1, 0.1, 0.1]
    display.FontSize = 14


# Parts: deformed, coloured, with a clip that shows their inside.
parts = read(PROBLEM, PROBLEM_FILE)
deformed = warped("deformed", parts)
clip = Clip(registrationName="clip", Input=deformed)
clip.ClipType = "Plane"
clip.ClipType.Origin = CENTRE
clip.ClipType.Normal = NORMAL
clip.Invert = 1
view = set_up(GetActiveViewOrCreate("RenderView"), 960 if INTERFACES_FILE else 1440)  # ParaView starts with an empty one
layout = GetLayout(view)
if not layout:
    layout = CreateLayout("dygita")
    AssignViewToLayout(view=view, layout=layout, hint=0)
for source in (deformed, clip):
    display = Show(source, view)
    display.Representation = "Surface"
    display.Ambient = 0.25
    colored(view, display, FIELD, FIELD_TITLE, TOP)
    display.Visibility = 1 if (source is clip) == IS_CUT else 0
label(view, TITLE, "Upper Left Corner")
time = AnnotateTimeFilter(registrationName="time", Input=parts)
time.Scale = 1e6
time.Format = "{time:.4g} us" if "{" in time.Format else "%.4g us"
display = Show(time, view)
display.WindowLocation = "Lower Left Corner"
display.Color = [0.1, 0.1, 0.1]

# Interfaces beside them, turned with them.
if INTERFACES_FILE:
    interfaces = read("interfaces", INTERFACES_FILE)
    deformed_interfaces = warped("deformed interfaces", interfaces)
    second = set_up(CreateView("RenderView"), 960)
    layout.SplitHorizontal(0, 0.5)
    AssignViewToLayout(view=second, layout=layout, hint=2)
    display = Show(deformed_interfaces, second)
    display.Representation = "Surface"
    colored(second, display, "pressure", "pressure on interfaces (Pa)", PRESSURE)
    ghost = Show(parts, second)
    ghost.Representation = "Feature Edges"
    ghost.ColorArrayName = ["POINTS", ""]
    ghost.AmbientColor = ghost.DiffuseColor = [0.7, 0.7, 0.7]
    AddCameraLink(view, second, "dygita")
    label(second, "interfaces", "Upper Left Corner")

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = TIME
SetActiveView(view)
SetActiveSource(deformed)  # the clip would show its plane
for one in [view, second] if INTERFACES_FILE else [view]:  # a window's views have the size they find room for
    width, height = one.ViewSize
    one.CameraParallelScale = max(HALF_HEIGHT, HALF_WIDTH * height / max(1, width))
RenderAllViews()
if len(sys.argv) == 2 and sys.argv[1].endswith(".png"):  # pvpython view.py picture.png
    SaveScreenshot(sys.argv[1], layout, ImageResolution=[1920 if INTERFACES_FILE else 1440, 720])

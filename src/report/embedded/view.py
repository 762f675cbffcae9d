import ctypes
import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree

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


def draws_without_display():
    """Is this ParaView made to draw in memory?"""
    from vtkmodules import vtkRenderingOpenGL2 as windows

    return any(hasattr(windows, name) for name in ("vtkEGLRenderWindow", "vtkOSOpenGLRenderWindow", "vtkOpenGLHeadlessRenderWindow"))


def open_display():
    """A connection to the X server that DISPLAY names; none: it is not there."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return x11.XOpenDisplay(None) if os.environ.get("DISPLAY") else None


def find_display():
    """ParaView ends in a segmentation fault where it has nothing to draw on: then an X server in memory, as long as the script runs."""
    if not sys.platform.startswith("linux") or os.path.basename(os.path.realpath("/proc/self/exe")).startswith("paraview"):
        return  # a window is there
    if draws_without_display() or open_display():
        return
    server = shutil.which("Xvfb")
    if not server:
        sys.exit("view.py: no display to draw on, and this ParaView draws on nothing else\n    install Xvfb (Debian: apt-get install xvfb), "
                 "or set DISPLAY to a screen that is there")
    reading, writing = os.pipe()
    # It ends with its last client, which is the connection opened here.
    subprocess.Popen([server, "-displayfd", str(writing), "-screen", "0", "2000x1400x24", "-terminate", "-nolisten", "tcp"],
                     pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        os.environ["DISPLAY"] = ":" + pipe.readline().strip()
    if not open_display():
        sys.exit("view.py: no display to draw on, and Xvfb does not start: try `Xvfb :99`, and see what it says")


find_display()


def read(name, file):
    """A .pvd of the run's folder, at the instant shown."""
    source = PVDReader(registrationName=name, FileName=os.path.join(folder, file))
    source.UpdatePipeline(TIME)
    return source


def names_of(file):
    """Of the blocks of a .pvd, in their order."""
    names = {}
    for entry in xml.etree.ElementTree.parse(os.path.join(folder, file)).iter("DataSet"):
        names.setdefault(int(entry.get("part")), entry.get("name"))
    return [names[part] for part in sorted(names)]


def values_of(source, field):
    """Some of the values of a point field, rising; none where the data are elsewhere."""
    data = source.GetClientSideObject()
    data = data and data.GetOutputDataObject(0)
    grids = [data]
    if data and data.IsA("vtkCompositeDataSet"):
        grids, at = [], data.NewIterator()
        while not at.IsDoneWithTraversal():
            grids.append(at.GetCurrentDataObject())
            at.GoToNextItem()
    arrays = [a for a in (g.GetPointData().GetArray(field) for g in grids if g) if a and a.GetNumberOfComponents() == 1]
    step = max(1, sum(a.GetNumberOfTuples() for a in arrays) // 20000)
    values = (a.GetComponent(i, 0) for a in arrays for i in range(0, a.GetNumberOfTuples(), step))
    return sorted(v for v in values if v == v)


def range_of(source, field, top):
    """Of the colours: from zero; where a peak would leave half of what is seen the lowest fifth, three decades at most of a logarithmic scale."""
    values = values_of(source, field)
    if values and values[len(values) // 2] < 0.2 * top:
        return max(values[len(values) // 20], 1e-3 * top), top
    return 0.0, top


def in_unit(name, source, function):
    """A field in the unit of its title, under that title."""
    made = Calculator(registrationName=name, Input=source)
    made.Function = function
    made.ResultArrayName = name
    return made


def warped(name, source):
    warp = WarpByVector(registrationName=name, Input=source)
    warp.Vectors = ["POINTS", "displacement"]
    warp.ScaleFactor = WARP
    return warp


def colored(view, display, field, low, top):
    """Colours by a point field, on a logarithmic scale where they do not begin at zero; the legend below."""
    ColorBy(display, ("POINTS", field))
    table = GetColorTransferFunction(field)
    table.UseLogScale = 0
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.NanColor = [0.8, 0.8, 0.8]
    if top > 0.0:
        table.RescaleTransferFunction(low, top)
        GetOpacityTransferFunction(field).RescaleTransferFunction(low, top)
    if low > 0.0:
        table.MapControlPointsToLogSpace()
        table.UseLogScale = 1
    legend(view, display, table, field)


def legend(view, display, table, title):
    bar = GetScalarBar(table, view)
    bar.Title = title
    bar.ComponentTitle = ""
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"
    bar.ScalarBarLength = 0.4
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    display.SetScalarBarVisibility(view, True)


def by_part(view, display, names):
    """A colour and a name for each part."""
    display.BlockColorsDistinctValues = len(names)
    ColorBy(display, ("FIELD", "vtkBlockColors"))
    table = GetColorTransferFunction("vtkBlockColors")
    table.InterpretValuesAsCategories = 1
    table.Annotations = [text for part, name in enumerate(names) for text in (str(part), name)]
    table.IndexedColors = [c for part in range(len(names)) for c in COLORS[part % len(COLORS)]]
    legend(view, display, table, "part")
    if len(names) > 24:  # more than a legend holds
        display.SetScalarBarVisibility(view, False)


COLORS = [(0.90, 0.62, 0.00), (0.34, 0.71, 0.91), (0.00, 0.62, 0.45), (0.94, 0.89, 0.26), (0.00, 0.45, 0.70), (0.84, 0.37, 0.00),
          (0.80, 0.47, 0.65), (0.60, 0.60, 0.60), (0.55, 0.34, 0.29), (0.45, 0.76, 0.46), (0.62, 0.60, 0.85), (0.85, 0.75, 0.60)]


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


# Parts: deformed, coloured by stress, with a clip that shows their inside.
parts = read(PROBLEM, PROBLEM_FILE)
deformed = warped("deformed", parts)
is_stress = FIELD == "von_mises"
title = "von Mises stress (MPa)" if is_stress else "displacement (mm)"
shown = in_unit(title, deformed, "von_mises*1e-6" if is_stress else "mag(displacement)*1e3")
shown.UpdatePipeline(TIME)
clip = Clip(registrationName="clip", Input=shown)
clip.ClipType = "Plane"
clip.ClipType.Origin = CENTRE
clip.ClipType.Normal = NORMAL
clip.Invert = 1
view = set_up(GetActiveViewOrCreate("RenderView"), 960)  # ParaView starts with an empty one
layout = GetLayout(view)
if not layout:
    layout = CreateLayout("dygita")
    AssignViewToLayout(view=view, layout=layout, hint=0)
low, top = range_of(shown, title, TOP * (1e-6 if is_stress else 1e3))
for source in (shown, clip):
    display = Show(source, view)
    display.Representation = "Surface"
    display.Ambient = 0.25
    colored(view, display, title, low, top)
    display.Visibility = 1 if (source is clip) == IS_CUT else 0
label(view, TITLE, "Upper Left Corner")
time = AnnotateTimeFilter(registrationName="time", Input=parts)
time.Scale = 1e3
time.Format = "{time:.4g} ms" if "{" in time.Format else "%.4g ms"
display = Show(time, view)
display.WindowLocation = "Lower Left Corner"
display.Color = [0.1, 0.1, 0.1]
layout.SplitHorizontal(0, 0.5)

# The parts by name beside it, turned with it; below them the interfaces, inside the parts.
second = set_up(CreateView("RenderView"), 960)
AssignViewToLayout(view=second, layout=layout, hint=2)
display = Show(deformed, second)
display.Representation = "Surface"
display.Ambient = 0.25
by_part(second, display, names_of(PROBLEM_FILE))
AddCameraLink(view, second, "dygita")
label(second, "parts", "Upper Left Corner")
views = [view, second]
if INTERFACES_FILE:
    interfaces = read("interfaces", INTERFACES_FILE)
    deformed_interfaces = warped("deformed interfaces", interfaces)
    pressed = in_unit("pressure (MPa)", deformed_interfaces, "pressure*1e-6")
    pressed.UpdatePipeline(TIME)
    layout.SplitVertical(2, 0.5)
    third = set_up(CreateView("RenderView"), 960)
    AssignViewToLayout(view=third, layout=layout, hint=6)
    display = Show(pressed, third)
    display.Representation = "Surface"
    colored(third, display, "pressure (MPa)", *range_of(pressed, "pressure (MPa)", PRESSURE * 1e-6))
    ghost = Show(deformed, third)
    ghost.Representation = "Surface"
    ghost.ColorArrayName = ["POINTS", ""]
    ghost.AmbientColor = ghost.DiffuseColor = [0.6, 0.6, 0.6]
    ghost.Opacity = 0.1
    AddCameraLink(view, third, "dygita interfaces")
    label(third, "interfaces", "Upper Left Corner")
    views.append(third)

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = TIME
SetActiveView(view)
SetActiveSource(deformed)  # the clip would show its plane
is_saved = len(sys.argv) == 2 and sys.argv[1].endswith(".png")  # pvpython view.py picture.png
resolution = [1920, 1080 if INTERFACES_FILE else 720]
for one in views:  # a window's views have the size they find room for
    width, height = one.ViewSize
    if is_saved:
        width, height = resolution[0] // 2, resolution[1] // (2 if INTERFACES_FILE and one is not view else 1)
    one.CameraParallelScale = max(HALF_HEIGHT, HALF_WIDTH * height / max(1, width))
RenderAllViews()
if is_saved:
    SaveScreenshot(sys.argv[1], layout, ImageResolution=resolution)

"""Renders the pictures of the manual from the runs of the decks, with ParaView 5.11 or later.

    ./run.sh run decks/bolted_flanges.lua
    ./run.sh run decks/crush.lua
    ./run.sh run decks/crush.lua --set mu=0 --out out/mu0
    xvfb-run -a pvbatch manual/pictures/render.py

Run in the repository's root; reads out/, writes manual/pictures/*.png.
"""

import sys

from paraview import simple as pv

pv._DisableFirstRenderCameraReset()
INK = [0.1, 0.1, 0.1]


def panel(pvd, time, half, warp, field, colours, camera, text):
    """One view of a run at one instant, half of it cut away at y = 0 where `half`; answers the view."""
    view = pv.CreateView("RenderView")
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    reader = pv.PVDReader(FileName=pvd)
    instant = pv.ForceTime(Input=reader, ForcedTime=time, IgnorePipelineTime=1)  # whatever the scene's clock says
    source = pv.MergeBlocks(Input=instant, MergePoints=0)  # parts that touch keep their own points
    if half:
        source = pv.Clip(Input=source, ClipType="Plane", Invert=0)
        source.ClipType.Origin = [0, 0, 0]
        source.ClipType.Normal = [0, 1, 0]
    source = pv.WarpByVector(Input=source, Vectors=["POINTS", "displacement"], ScaleFactor=warp)
    name, unit, scale, top = field
    shape = pv.Show(pv.Calculator(Input=source, ResultArrayName=name, Function=scale), view)
    shape.SetRepresentationType("Surface With Edges")
    shape.EdgeColor = [0.35, 0.35, 0.35]
    shape.LineWidth = 0.6
    shape.Ambient, shape.Diffuse = 0.4, 0.75
    pv.ColorBy(shape, ("POINTS", name))
    table = pv.GetColorTransferFunction(name)
    table.ApplyPreset(colours, True)
    table.RescaleTransferFunction(0.0, top)
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = f"{name} [{unit}]", ""
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize = bar.LabelFontSize = 13
    bar.Orientation, bar.WindowLocation, bar.Position = "Horizontal", "Any Location", [0.2, 0.03]
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.6, 12
    bar.RangeLabelFormat = bar.LabelFormat = "%g"
    bar.AutomaticLabelFormat = 0
    shape.SetScalarBarVisibility(view, True)
    label = pv.Show(pv.Text(Text=text), view)
    label.Color, label.FontSize, label.WindowLocation = INK, 13, "Upper Center"
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = camera
    view.CameraParallelProjection = 1
    return view


def picture(file, size, panels):
    """Panels side by side, each (arguments of `panel`, parallel scale)."""
    layout = pv.CreateLayout(file)
    views = []
    for arguments, scale in panels:
        view = panel(*arguments)
        view.CameraParallelScale = scale
        views.append(view)
    cell = 0
    pv.AssignViewToLayout(view=views[0], layout=layout, hint=0)
    for i, view in enumerate(views[1:], 1):
        cell = layout.SplitHorizontal(cell, 1.0 / (len(views) - i + 1)) + 1
        pv.AssignViewToLayout(view=view, layout=layout, hint=cell)
    layout.SetSize(*size)
    pv.SaveScreenshot(file, layout, ImageResolution=size, CompressionLevel="9")


FLANGES = "out/bolted_flanges/base/bolted_flanges.pvd"
ACROSS = ([0.10, -0.16, 0.085], [0, 0, 0.012], [0, 0, 1])
picture(
    "manual/pictures/bolted_flanges.png",
    (960, 450),
    [
        ((FLANGES, 0.0, True, 100, ("von Mises, tightened", "MPa", "von_mises/1e6", 400), "Viridis (matplotlib)", ACROSS,
          "tightened: 29.56 kN in the bolt (warp x100)"), 0.037),
        ((FLANGES, 40e-6, True, 20, ("von Mises, 40 us", "MPa", "von_mises/1e6", 800), "Viridis (matplotlib)", ACROSS,
          "40 us into the shock: open and yielding (warp x20)"), 0.037),
    ],
)

CORNER = ([0.08, 0.06, 0.045], [0.005, 0.005, 0.018], [0, 0, 1])
SPREAD = ("sideways displacement", "um", "sqrt(displacement_X^2+displacement_Y^2)*1e6", 36)
picture(
    "manual/pictures/crush.png",
    (800, 500),
    [
        (("out/mu0/crush/base/crush.pvd", 42e-6, False, 50, SPREAD, "Viridis (matplotlib)", CORNER,
          "friction 0, t = 42 us (warp x50)"), 0.027),
        (("out/crush/base/crush.pvd", 42e-6, False, 50, SPREAD, "Viridis (matplotlib)", CORNER,
          "friction 0.3, t = 42 us (warp x50)"), 0.027),
    ],
)
sys.stdout.flush()

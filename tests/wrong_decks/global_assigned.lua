thickness = 3*mm

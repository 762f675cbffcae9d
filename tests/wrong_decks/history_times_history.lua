local a, b = history.ramp{ to = 1, duration = 1*ms }, history.half_sine{ peak = 3, duration = 1*ms }
local c = a * b

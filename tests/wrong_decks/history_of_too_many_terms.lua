local h = history.half_sine{ peak = 1, duration = 1 }
for i = 1, 60 do h = h + h:shifted(1e-6) end

local n = 3
if n > 2 && n < 5 then print(n) end

local level = 20*g

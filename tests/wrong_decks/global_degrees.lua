local angle = 20*degrees
